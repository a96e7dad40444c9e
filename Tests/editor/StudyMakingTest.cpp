// Studies are made in the window as the command makes them.

#include "editor/Bench.h"
#include "editor/study/NewStudySheet.h"
#include "study/StudyFile.h"
#include "support/TempFolder.h"

using namespace pacini;
using namespace pacini::test;

namespace
{
std::filesystem::path twoSounds(const TempFolder& folder)
{
    std::filesystem::create_directories(folder / "sounds");
    for (const char* name : {"knock_wood_bridge", "impact_boom"})
        std::filesystem::copy_file(demoSound(name), folder / "sounds" / (std::string(name) + ".flac"));
    put(folder / "sounds" / "notes.txt", "no sound");
    return folder / "sounds";
}
} // namespace

TEST_CASE("A study is made of a template, the sounds of a folder and groups, and none is replaced")
{
    const TempFolder folder;
    const editor::StudyWish wish{"mushra", folder / "new" / "study", twoSounds(folder), {{"ours", 5}}};
    const auto made = editor::makeStudyFile(wish);
    REQUIRE(made);
    CHECK(*made == folder / "new" / "study" / "study.json");
    const auto study = study::readStudy(*made);
    REQUIRE(study);
    REQUIRE(study->groups.size() == 1);
    CHECK(study->groups[0].name == "ours");
    CHECK(study->groups[0].size == 5);
    for (const auto& stimulus : study->stimuli)
        if (!stimulus.sound.empty())
            CHECK(std::filesystem::exists(folder / "new" / "study" / stimulus.sound)); // its path is from the folder
    const auto again = editor::makeStudyFile(wish);
    REQUIRE_FALSE(again);
    CHECK(again.error().code == ErrorCode::io);
}

TEST_CASE("A study that cannot be made says why, and leaves no file")
{
    const TempFolder folder;
    const auto sounds = twoSounds(folder);
    const auto fails = [&](const editor::StudyWish& wish)
    {
        const auto made = editor::makeStudyFile(wish);
        REQUIRE_FALSE(made);
        CHECK_FALSE(made.error().text().empty());
        CHECK_FALSE(std::filesystem::exists(folder / "study" / "study.json"));
    };
    fails({"mushra", {}, sounds, {}});
    fails({"mushra", folder / "study", {}, {}}); // needs sounds
    fails({"mushra", folder / "study", folder / "not there", {}});
    fails({"no template", folder / "study", sounds, {}});
    fails({"mushra", folder / "study", sounds, {{"A", 0}}});
    fails({"mushra", folder / "study", sounds, {{"A", 2}, {"A", 2}}});
    CHECK(editor::makeStudyFile({"jnd", folder / "study", {}, {}})); // which needs none
    // Nobody has answered yet.
    const auto report = editor::reportStudy(folder / "study");
    REQUIRE_FALSE(report);
    CHECK_FALSE(report.error().text().empty());
}

TEST_CASE("The sheet of a new study offers all templates with their groups, tells problems, and offers to run it")
{
    const TempFolder folder;
    EditorBench bench;
    std::filesystem::path run;
    editor::HostServices around;
    around.runStudy = [&](const std::filesystem::path& file)
    {
        run = file;
    };
    editor::EditorView view(bench.session, around);
    view.setBounds(0, 0, 1280, 800);
    REQUIRE(view.doCommand(editor::newStudy));
    auto& sheet = *view.sheet();
    auto& question = get<juce::ComboBox>(sheet, "Question");
    CHECK(question.getNumItems() >= 9);
    const auto wish = [&]
    {
        return dynamic_cast<editor::NewStudySheet&>(sheet).wish();
    };
    for (int i = 0; i < question.getNumItems(); ++i)
    {
        question.setSelectedItemIndex(i, juce::sendNotificationSync);
        CAPTURE(question.getText());
        CHECK_FALSE(wish().groups.empty());
    }
    get<juce::TextEditor>(sheet, "Folder").setText((folder / "study").string(), true);
    get<juce::TextEditor>(sheet, "Sounds").setText((folder / "nothing").string(), true);
    answer(sheet, "Create");
    CHECK(view.sheet() == &sheet);
    CHECK(get<juce::Label>(sheet, "Problem").getText().isNotEmpty());
    get<juce::TextEditor>(sheet, "Sounds").setText(twoSounds(folder).string(), true);
    for (int i = 0; i < question.getNumItems(); ++i)
        if (question.getItemText(i).startsWith("MUSHRA"))
            question.setSelectedItemIndex(i, juce::sendNotificationSync);
    get<juce::TextEditor>(sheet, "People in group 1").setText("7", true);
    answer(sheet, "Create");
    const auto read = study::readStudy(folder / "study" / "study.json");
    REQUIRE(read);
    CHECK(read->groups[0].size == 7);
    view.showSheet(nullptr); // what waits is shown then
    REQUIRE(view.sheet() != nullptr);
    answer(*view.sheet(), "Run");
    CHECK(run == folder / "study" / "study.json");
}
