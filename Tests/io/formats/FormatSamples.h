#pragma once

// Formats under test, and files with everything in them.

#include "io/formats/android/AndroidFormat.h"
#include "io/formats/csv/CsvFormat.h"
#include "io/formats/haps/HapsFormat.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/samples/PcmFormat.h"
#include "io/formats/tact/TactFormat.h"

#include <array>
#include <string>

namespace pacini::test
{

/// What HJIF needs around the bands of its only channel.
inline std::string hjifWith(const std::string& bands, const std::string& library = "")
{
    return R"({"version": "2023", "profile": "Main", "level": 1, "date": "2026-01-01", "description": "sample",
        "timescale": 1000, "avatars": [], "syncs": [], "perceptions": [{"id": 0, "avatar_id": 0, "description": "",
        "perception_modality": "Vibrotactile", "effect_library": [)" +
           library + R"(], "channels": [{"id": 0, "description": "", "gain": 1, "mixing_coefficient": 1,
        "body_part_mask": 0, "bands": [)" +
           bands + "]}]}]}";
}

inline std::string hjifSample()
{
    return hjifWith(R"(
        {"band_type": "VectorialWave", "lower_frequency_limit": 40, "upper_frequency_limit": 120, "effects": [
          {"effect_type": "Basis", "position": 0, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0.1, "frequency_modulation": 60},
            {"relative_position": 150, "amplitude_modulation": 0.8},
            {"relative_position": 222, "frequency_modulation": 90},
            {"relative_position": 400, "amplitude_modulation": 0.25, "frequency_modulation": 75}]},
          {"effect_type": "Basis", "position": 600, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 50},
            {"relative_position": 200, "amplitude_modulation": 0.2}]},
          {"effect_type": "Reference", "position": 1000, "id": 7}]},
        {"band_type": "VectorialWave", "lower_frequency_limit": 200, "upper_frequency_limit": 200, "effects": [
          {"effect_type": "Basis", "position": 0, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0.0, "frequency_modulation": 200},
            {"relative_position": 1200, "amplitude_modulation": 0.3}]}]},
        {"band_type": "Transient", "lower_frequency_limit": 65, "upper_frequency_limit": 300, "effects": [
          {"effect_type": "Basis", "position": 100, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0.5, "frequency_modulation": 100}]},
          {"effect_type": "Basis", "position": 300, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0.3, "frequency_modulation": 70}]}]},
        {"band_type": "VectorialWave", "lower_frequency_limit": 280, "upper_frequency_limit": 280, "effects": [
          {"effect_type": "Basis", "position": 700, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0, "frequency_modulation": 250},
            {"relative_position": 2, "amplitude_modulation": 0.35}, {"relative_position": 4, "amplitude_modulation": 0.7},
            {"relative_position": 6, "amplitude_modulation": 0.35}, {"relative_position": 8, "amplitude_modulation": 0}]}]}
        )",
                    R"({"effect_type": "Basis", "id": 7, "position": 0, "keyframes": [
            {"relative_position": 0, "amplitude_modulation": 0.4, "frequency_modulation": 110},
            {"relative_position": 100, "amplitude_modulation": 0.1}]})");
}

inline std::string androidEnvelopeSample(bool isBasic)
{
    return isBasic ? R"({"name": "e", "basicEnvelope": {"initialSharpness": 0.2, "controlPoints": [
            {"intensity": 0.5, "sharpness": 0.5, "durationMs": 30}, {"intensity": 0.9, "sharpness": 0.1, "durationMs": 7},
            {"intensity": 0.9, "sharpness": 1, "durationMs": 800}, {"intensity": 0, "sharpness": 0, "durationMs": 40}]}})"
                   : R"({"name": "e", "waveformEnvelope": {"initialFrequencyHz": 60, "controlPoints": [
            {"amplitude": 0.5, "frequencyHz": 80.5, "durationMs": 30}, {"amplitude": 0.9, "frequencyHz": 200, "durationMs": 7},
            {"amplitude": 0.9, "frequencyHz": 90, "durationMs": 800}, {"amplitude": 0, "frequencyHz": 90, "durationMs": 40}]}})";
}

inline std::string androidWaveformSample()
{
    return R"({"name": "w", "waveform": {"timings": [100, 30, 1, 60, 500, 20], "amplitudes": [0, 255, 17, 0, 3, 128],
        "repeat": -1}})";
}

inline std::string hapsSample()
{
    return R"({"m_version": "5", "m_description": "d", "m_HDFlag": 0, "m_time_unit": 0, "m_length_unit": 7, "m_gain": 1,
      "m_vibration": {"m_gain": 1, "m_loop": 0, "m_maximum": 1, "m_signalEvaluationMethod": 3, "m_melodies": [
        {"m_gain": 1, "m_mute": 0, "m_notes": [
          {"m_startingPoint": 0.125, "m_length": 0.022, "m_priority": 0, "m_gain": 1.109, "m_hapticEffect": {"m_type": 0}},
          {"m_startingPoint": 0.5, "m_length": 0.022, "m_priority": 0, "m_gain": 0.3, "m_hapticEffect": {"m_type": 0}}]},
        {"m_gain": 1, "m_mute": 0, "m_notes": [
          {"m_startingPoint": 0, "m_length": 1.5, "m_priority": 1, "m_gain": 1, "m_hapticEffect": {
            "m_amplitudeModulation": {"m_extrapolationStrategy": 0, "m_keyframes": [{"m_time": 0, "m_value": 0.2},
              {"m_time": 0.4, "m_value": 1}, {"m_time": 0.4, "m_value": 0.5}, {"m_time": 1.5, "m_value": 0}]},
            "m_frequencyModulation": {"m_extrapolationStrategy": 0, "m_keyframes": [{"m_time": 0, "m_value": 60},
              {"m_time": 1, "m_value": 310.5}, {"m_time": 1.5, "m_value": 100}]}}}]}]}})";
}

inline std::string tactSample()
{
    return R"({"project": {"name": "t", "createdAt": 0, "mediaFileDuration": 1, "layout": {}, "tracks": [{"enable": true,
      "effects": [{"name": "a", "startTime": 40, "offsetTime": 400, "modes": {
        "VestFront": {"mode": "DOT_MODE", "dotMode": {"feedback": [
          {"startTime": 0, "endTime": 100, "playbackType": "NONE", "pointList": [{"index": 3, "intensity": 0.5},
            {"index": 4, "intensity": 0.75}]},
          {"startTime": 100, "endTime": 200, "playbackType": "NONE", "pointList": [{"index": 3, "intensity": 0.25}]},
          {"startTime": 300, "endTime": 400, "playbackType": "NONE", "pointList": [{"index": 3, "intensity": 1}]}]},
          "pathMode": {"feedback": []}}}}]}]}, "durationMillis": 500, "intervalMillis": 20, "size": 20})";
}

inline std::string csvSample()
{
    return "time,envelope,amplitude 30 50 80,pitch 30 50 80,amplitude 80 100 120,noise 10 20,event,sharpness\n"
           "0,0.5,0.25,45,,,,\n0.1,,,,0.125,0.5,,\n0.1,,,,1,,,\n0.25,,,,,,0.75,0.5\n0.25,,,,,,1,0\n1.5,,0,60,0,,,\n2,,,"
           ",,,,\n";
}

} // namespace pacini::test
