#include "io/AtomicFile.h"
#include "io/schema/DocumentTool.h"
#include "study/Questionnaires.h"
#include "study/StudyFile.h"
#include "study/StudyTemplates.h"

using namespace pacini;

namespace
{
/// The templates, and one study that has everything.
study::Study sample(int number)
{
    const auto templates = study::studyTemplates();
    const std::size_t which = static_cast<std::size_t>(number) % (templates.size() + 1);
    if (which < templates.size())
        return study::makeStudy(templates[which].name, templates[which].mostSounds == 0
                                                           ? std::vector<std::string>()
                                                           : std::vector<std::string>{"a.wav", "b.wav", "c.wav"})
            .value();
    study::Study whole = study::makeStudy("coherence", {"a.wav", "b.wav", "c.wav"}).value();
    whole.profile = "l5-wristband";
    whole.comfort = {"a"};
    whole.stimuli[0].clip = "a.pacb";
    whole.stimuli[1].drive = "b.wav";
    whole.stimuli[2].method = "percept";
    whole.stimuli[2].bits = 6;
    whole.stimuli[2].bands = 4;
    whole.stimuli[2].breakpoints = 10;
    study::Stimulus silence;
    silence.name = "silence";
    silence.silence = 1.0;
    study::Stimulus tone;
    tone.name = "tone";
    tone.tone = study::Tone{};
    tone.sensationLevel = 20.0;
    whole.stimuli[0].acceleration = 5.0;
    whole.stimuli.push_back(silence);
    whole.stimuli.push_back(tone);
    study::Block block;
    block.name = "sorting";
    block.task = study::Task::multiStimulus;
    block.stimuli = {"a", "b"};
    block.training = {"c"};
    block.reference = "tone";
    block.anchors = {"silence"};
    block.adaptive.procedure = study::Procedure::levitt;
    block.scale.step = 1.0;
    whole.blocks.push_back(block);
    whole.row.actuators = 2;
    tone.name = "here";
    tone.sensationLevel = std::nullopt;
    tone.place = study::Place{};
    tone.label = {{"en", "buzz"}};
    whole.stimuli.push_back(tone);
    study::Stimulus mix;
    mix.name = "both";
    mix.mix = {"a", "here"};
    whole.stimuli.push_back(mix);
    whole.stimuli[0].object = study::SoundObject{study::Mass::complex, study::Facture::iterative};
    whole.stimuli[1].tags = {"loud"};
    whole.calibration = study::SoundCalibration{};
    whole.limits.soundLevel = 80.0;
    whole.limits.soundDaily = 75.0;
    whole.limits.loudness = -10.0;
    study::Block asksWhich;
    asksWhich.name = "which";
    asksWhich.task = study::Task::which;
    asksWhich.stimuli = {"both", "here"};
    whole.blocks.push_back(asksWhich);
    (void)study::addQuestionnaire(whole, "demographics");
    return whole;
}
} // namespace

int main(int argc, char** argv)
{
    const auto writeSample = [](const std::filesystem::path& path, int number)
    {
        return writeFileAtomically(path, study::studyJson(sample(number)));
    };
    return test::documentTool(argc, argv, writeSample,
                              [](std::string_view text) { return study::readStudyJson(text); });
}
