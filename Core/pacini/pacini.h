#pragma once

// All of the core that programs mostly need: encode, render, translate live, measure and flatten an actuator, compare.

// Where <windows.h> came first without NOMINMAX, its macros would take every std::min and std::max.
#pragma push_macro("min")
#pragma push_macro("max")
#undef min
#undef max

#include <pacini/actuator/Profile.h>
#include <pacini/analysis/EncodeSound.h>
#include <pacini/analysis/Encoder.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/HtsAnalyzer.h>
#include <pacini/linearize/EqualizedSweep.h>
#include <pacini/linearize/EqualizerFit.h>
#include <pacini/linearize/SweepAnalysis.h>
#include <pacini/realtime/Translator.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/RenderScene.h>
#include <pacini/synthesis/ScenePlayer.h>

#pragma pop_macro("max")
#pragma pop_macro("min")
