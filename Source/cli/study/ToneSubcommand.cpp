#include "cli/study/ToneSubcommand.h"

#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "io/AudioFile.h"
#include "study/SoundLevel.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace pacini::cli
{

namespace
{
/// `study tone`: the tone by which the level of a study's sounds is calibrated.
struct ToneSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand("tone", "Write the tone to calibrate the level of sounds with");
        addOption(*command, "output", output, "Sound file to write (WAV)", "WAV")->required();
        addOption(*command, "--level", calibration.tone, "Level, dB re full scale (RMS)", numberFrom(-100.0, -3.1),
                  "DB")
            ->capture_default_str();
        addOption(*command, "--duration", duration, "Duration, s", numberFrom(1.0, 600.0), "S")->capture_default_str();
        addOption(*command, "--sample-rate", sampleRate, "Sample rate, Hz", wholeNumberFrom(8000, 192000), "HZ")
            ->capture_default_str();
        overwriting.declare(*command);
        return command->footer(
            "Play the tone (1 kHz) with the headphones and the settings of the study, measure its level at the ear "
            "in dB SPL,\nand enter it in study.json:\n"
            "  \"calibration\": {\"tone\": -20, \"level\": 74}\n"
            "pacini study check then tells the level of each sound in dB SPL and dB(A), and nothing louder than\n"
            "limits.soundLevel is played.");
    }

    Exit run(Console& console) override
    {
        if (overwriting.keeps(console, {output}))
            return Exit::ok;
        if (isOccupied(output) && !overwriting.replacesAll())
            return console.fail(output, {ErrorCode::io, "", "exists; -y replaces it"});
        AudioWriteParams writing;
        writing.sampleRate = sampleRate;
        writing.channels = 2;
        writing.encoding = SampleEncoding::pcm24;
        auto writer = AudioWriter::create(output, writing);
        if (!writer)
            return console.fail(output, writer.error());
        std::vector<float> both;
        for (const float sample : study::calibrationTone(calibration, duration, sampleRate))
            both.insert(both.end(), {sample, sample});
        if (auto written = writer->write(both); !written)
            return console.fail(output, written.error());
        if (const auto finished = writer->finish(); !finished)
            return console.fail(output, finished.error());
        console.addToReport({{"output", output}, {"tone", calibration.tone}});
        console.wrote(output, fmt::format("1 kHz at {} dB re full scale (RMS) for {} s, on both channels",
                                          calibration.tone, duration));
        return Exit::ok;
    }

    std::string output;
    study::SoundCalibration calibration;
    double duration = 30.0;
    int sampleRate = 48000;
    OverwriteOptions overwriting;
};
} // namespace

std::unique_ptr<Command> toneStudySubcommand()
{
    return std::make_unique<ToneSubcommand>();
}

} // namespace pacini::cli
