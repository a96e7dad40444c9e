// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/PluginProcessor.h"
#include <juce_audio_utils/juce_audio_utils.h>
class A : public juce::JUCEApplication { public:
 const juce::String getApplicationName() override {return "Pacini";}
 const juce::String getApplicationVersion() override {return "0";}
 void initialise(const juce::String&) override {
   w=std::make_unique<juce::DocumentWindow>("Pacini", juce::Colours::black, 7);
   w->setUsingNativeTitleBar(true);
   w->setContentOwned(p.createEditorIfNeeded(), true); w->setVisible(true); w->setTopLeftPosition(0,0);}
 void shutdown() override { w.reset(); }
 pacini::plugin::PluginProcessor p; std::unique_ptr<juce::DocumentWindow> w; };
juce::JUCEApplicationBase* juce_CreateApplication();
juce::JUCEApplicationBase* juce_CreateApplication() { return new A; }
