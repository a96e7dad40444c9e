// The editor looks as it did when somebody looked at it: twelve states beside pictures that were approved.
//
// Approve what it looks like now, after looking at each: PACINI_PIN=1 build/release/bin/pacini_editor_tests "Twelve*"

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/Translation.h"
#include "editor/clip/session/ClipSteps.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// Means of red, green and blue over squares of 16 pixels: what is left of a picture when fonts and the smoothing of
/// lines have made no difference.
struct Blocks
{
    static constexpr int size = 16;
    int width = 0, height = 0;
    std::vector<std::array<float, 3>> means;
};

Blocks blocksOf(const juce::Image& image, int size)
{
    Blocks blocks;
    blocks.width = image.getWidth() / size;
    blocks.height = image.getHeight() / size;
    const juce::Image::BitmapData pixels(image, juce::Image::BitmapData::readOnly);
    for (int y = 0; y < blocks.height; ++y)
        for (int x = 0; x < blocks.width; ++x)
        {
            std::array<float, 3> sum{};
            for (int v = 0; v < size; ++v)
                for (int u = 0; u < size; ++u)
                {
                    const auto c = pixels.getPixelColour(x * size + u, y * size + v);
                    sum[0] += static_cast<float>(c.getRed());
                    sum[1] += static_cast<float>(c.getGreen());
                    sum[2] += static_cast<float>(c.getBlue());
                }
            for (float& value : sum)
                value /= static_cast<float>(size * size);
            blocks.means.push_back(sum);
        }
    return blocks;
}

/// The share of squares that look different: by more than a tenth of full scale. 1 where the sizes differ.
double difference(const Blocks& a, const Blocks& b)
{
    if (a.width != b.width || a.height != b.height)
        return 1.0;
    std::size_t other = 0;
    for (std::size_t i = 0; i < a.means.size(); ++i)
    {
        float most = 0.0f;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(a.means[i][c] - b.means[i][c]));
        other += most > 25.5f ? 1u : 0u;
    }
    return static_cast<double>(other) / static_cast<double>(a.means.size());
}

constexpr double tolerance = 0.01; // of all squares

/// What is seen when the pictures that come from the background are there and nothing moves.
juce::Image seen(editor::EditorView& view)
{
    const auto now = [&view]
    {
        return view.createComponentSnapshot(view.getLocalBounds(), true, 1.0f);
    };
    juce::Image last = now();
    for (int still = 0, tries = 0; still < 3 && tries < 60; ++tries)
    {
        pumpFor(0.1);
        const juce::Image next = now();
        still = difference(blocksOf(last, 4), blocksOf(next, 4)) == 0.0 ? still + 1 : 0;
        last = next;
    }
    return last;
}

struct State
{
    const char* name;
    std::function<void(EditorBench&)> bring;
};

void openPage(EditorBench& bench, int index)
{
    bench.openDemo("drums_tabla_pattern");
    bench.view.sidePanel().setCurrentTabIndex(index);
}

void openSheet(EditorBench& bench, editor::Command command)
{
    bench.openDemo("drums_tabla_pattern");
    REQUIRE(bench.view.doCommand(command));
}

const std::vector<State> states{
    {"start",
     [](EditorBench&) {
     }},
    {"clip",
     [](EditorBench& bench)
     {
         bench.openDemo("drums_tabla_pattern");
     }},
    {"clip-light",
     [](EditorBench& bench)
     {
         bench.openDemo("drums_tabla_pattern");
         bench.view.setDark(false);
     }},
    {"selection",
     [](EditorBench& bench)
     {
         bench.openDemo("drums_tabla_pattern");
         REQUIRE(bench.view.doCommand(editor::selectAll));
     }},
    {"analysis",
     [](EditorBench& bench)
     {
         openPage(bench, 1);
     }},
    {"play",
     [](EditorBench& bench)
     {
         openPage(bench, 3);
     }},
    {"export",
     [](EditorBench& bench)
     {
         openSheet(bench, editor::exportClips);
     }},
    {"preferences",
     [](EditorBench& bench)
     {
         openSheet(bench, editor::preferences);
     }},
    {"shortcuts",
     [](EditorBench& bench)
     {
         openSheet(bench, editor::shortcuts);
     }},
    {"measure",
     [](EditorBench& bench)
     {
         openSheet(bench, editor::measureActuator);
     }},
    {"small",
     [](EditorBench& bench)
     {
         bench.view.setBounds(0, 0, 880, 600);
         bench.openDemo("drums_tabla_pattern");
     }},
    {"large",
     [](EditorBench& bench)
     {
         bench.openDemo("drums_tabla_pattern");
         bench.view.setScale(1.5);
     }},
};

juce::Image stateNow(const State& state)
{
    EditorBench bench({shipped("lra-175")});
    state.bring(bench);
    return seen(bench.view);
}

juce::File approved(const std::string& name)
{
    return juce::File((sourceFolder() / "Tests/golden/editor" / (name + ".png")).string());
}
} // namespace

TEST_CASE("Twelve states of the editor look as they were approved")
{
    std::map<std::string, juce::Image> now;
    for (const State& state : states)
        now[state.name] = stateNow(state);
    if (std::getenv("PACINI_PIN") != nullptr)
        for (const auto& [name, image] : now)
        {
            REQUIRE(approved(name).getParentDirectory().createDirectory());
            REQUIRE(approved(name).deleteFile());
            juce::FileOutputStream out(approved(name));
            REQUIRE(juce::PNGImageFormat().writeImageToStream(
                image.rescaled(image.getWidth() / 2, image.getHeight() / 2), out));
        }
    std::map<std::string, Blocks> pictures;
    for (const auto& [name, image] : now)
    {
        CAPTURE(name);
        const juce::Image picture = juce::ImageFileFormat::loadFrom(approved(name));
        REQUIRE(picture.isValid());
        pictures[name] = blocksOf(picture, Blocks::size / 2);
        const double differs = difference(blocksOf(image, Blocks::size), pictures[name]);
        if (differs > tolerance)
        {
            const juce::File file =
                juce::File::getCurrentWorkingDirectory().getChildFile("now-" + juce::String(name) + ".png");
            file.deleteFile();
            juce::FileOutputStream out(file);
            juce::PNGImageFormat().writeImageToStream(image, out);
            INFO("beside " << approved(name).getFullPathName() << ": " << file.getFullPathName());
            CHECK(differs <= tolerance);
        }
    }
    // The tolerance is so narrow that no state passes for another.
    for (const auto& [name, picture] : pictures)
        for (const auto& [other, otherPicture] : pictures)
            if (name < other)
            {
                CAPTURE(name, other);
                CHECK(difference(picture, otherPicture) > tolerance);
            }
}

// For somebody who looks at all of them: PACINI_LOOK=folder build/release/bin/pacini_editor_tests "[look]"
TEST_CASE("Pictures of the windows in all sizes, themes and languages", "[.look]")
{
    const char* const wanted = std::getenv("PACINI_LOOK");
    REQUIRE(wanted != nullptr);
    const juce::File folder(wanted);
    REQUIRE(folder.createDirectory());
    const char* const only = std::getenv("PACINI_LOOK_ONLY"); // names that contain this
    struct Size
    {
        int width, height;
        double scale;
    };
    std::vector<State> all = states;
    for (const auto& [name, command] : {std::pair("new-study", editor::newStudy), std::pair("scene", editor::editScene),
                                        std::pair("gain", editor::changeGain), std::pair("humanise", editor::humanise),
                                        std::pair("about", editor::about), std::pair("palette", editor::searchCommands),
                                        std::pair("comparison", editor::compareWithTheSound)})
        all.push_back({name, [command = command](EditorBench& bench)
                       {
                           openSheet(bench, command);
                       }});
    all.push_back({"history", [](EditorBench& bench)
                   {
                       bench.openDemo("drums_tabla_pattern");
                       editor::editClip(bench.session.model, "Reverse", ReverseEdit{});
                       REQUIRE(bench.view.doCommand(editor::showHistory));
                   }});
    all.push_back({"feel-as-on", [](EditorBench& bench)
                   {
                       bench.session.actuators.setProfile("lra-175");
                       openSheet(bench, editor::feelAlike);
                   }});
    all.push_back({"project", [](EditorBench& bench)
                   {
                       openPage(bench, 2);
                   }});
    for (const char* language : {"en", "de", "ja"})
        for (const Size& size :
             {Size{1024, 700, 1.0}, Size{1280, 800, 1.0}, Size{1920, 1080, 1.0}, Size{2560, 1440, 2.0}})
            for (const bool dark : {true, false})
                for (const State& state : all)
                {
                    const auto name = juce::String(state.name) + "-" + language + "-" + juce::String(size.width) +
                                      (dark ? "-dark" : "-light") + ".png";
                    if (only != nullptr && !name.contains(only))
                        continue;
                    editor::useLanguage(language);
                    EditorBench bench({shipped("lra-175"), shipped("quest-controller")});
                    bench.view.setBounds(0, 0, size.width, size.height);
                    bench.view.setScale(size.scale);
                    bench.view.setDark(dark);
                    state.bring(bench);
                    bench.view.setBounds(0, 0, size.width, size.height);
                    const auto image = seen(bench.view);
                    folder.getChildFile(name).deleteFile();
                    juce::FileOutputStream out(folder.getChildFile(name));
                    REQUIRE(juce::PNGImageFormat().writeImageToStream(image, out));
                }
    editor::useLanguage("en");
}
