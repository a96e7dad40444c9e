#include "study/Questionnaires.h"
#include "study/Session.h"
#include "study/StudyExport.h"
#include "study/StudyFile.h"
#include "study/StudyResults.h"
#include "study/StudyTemplates.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::study;
using test::TempFolder;

namespace
{
Item numberItem(double low, double high, double step)
{
    Item item;
    item.name = "years";
    item.kind = QuestionKind::number;
    item.question = {{"en", "How many?"}};
    item.scale = {low, high, step, {}, {}};
    return item;
}

Answer answersOf(std::vector<std::pair<std::string, std::string>> items)
{
    Answer answer;
    answer.items = std::move(items);
    return answer;
}

const std::vector<std::pair<std::string, std::string>> wholeAnswers{
    {"age", "34"}, {"gender", "a | \"b\", c"}, {"handedness", "left"}, {"hearing", "none"}, {"touch", "none"}};

/// Runs one participant through a study of demographics.
std::filesystem::path answeredOnce(const TempFolder& folder)
{
    Study study = *makeStudy("questionnaire", {});
    study.blocks.resize(1);
    std::ofstream(folder.path() / "study.json", std::ios::binary) << studyJson(study);
    auto session = Session::begin(study, folder.path(), {});
    REQUIRE(session);
    REQUIRE((*session)->answer(answersOf(wholeAnswers)));
    CHECK((*session)->trial() == nullptr);
    return (*session)->path();
}

std::string fileOf(const std::vector<std::pair<std::string, std::string>>& files, const std::string& name)
{
    const auto found = std::find_if(files.begin(), files.end(), [&](const auto& one) { return one.first == name; });
    REQUIRE(found != files.end());
    return found->second;
}
} // namespace

TEST_CASE("Answers to questions are held against their range, steps and choices")
{
    const Item years = numberItem(0.0, 10.0, 0.5);
    for (const char* good : {"0", "10", "2.5", "1e1"})
        CHECK_FALSE(problemOf(years, good));
    for (const char* bad : {"", "-1", "10.5", "0.3", "two", "nan", "inf", "1 2", "3,5", "1e999"})
    {
        INFO(bad);
        CHECK(problemOf(years, bad));
    }
    Item optional = years;
    optional.optional = true;
    CHECK_FALSE(problemOf(optional, ""));
    Item choice = years;
    choice.kind = QuestionKind::choice;
    choice.choices = {{"left", {}}, {"right", {}}};
    CHECK_FALSE(problemOf(choice, "left"));
    CHECK(problemOf(choice, "Left"));
}

TEST_CASE("A questionnaire is one trial without a stimulus, whose answers are checked, kept and exported")
{
    TempFolder folder;
    Study study = *makeStudy("questionnaire", {});
    study.blocks.resize(1);
    CHECK(trialsOf(study, 0, 0).size() == 1);
    {
        auto session = Session::begin(study, folder.path(), {});
        REQUIRE(session);
        auto wrong = wholeAnswers;
        wrong[0].second = "340";
        CHECK((*session)->answer(answersOf(wrong)).error().where == "age");
        wrong.erase(wrong.begin());
        CHECK((*session)->answer(answersOf(wrong)).error().where == "age");
        CHECK((*session)->answered() == 0);
    }
    TempFolder other;
    answeredOnce(other);
    const auto results = readResults(other.path());
    REQUIRE(results);
    CHECK(results->warnings.empty());
    REQUIRE(results->items.size() == 5);
    CHECK(results->items[1].answer == "a | \"b\", c");
    const auto files = exportedFiles(*results);
    CHECK(fileOf(files, "questionnaires.csv").find("P001,all,demographics,gender,\"a | \"\"b\"\", c\"\n") !=
          std::string::npos);
    CHECK(fileOf(files, "bids/participants.tsv").find("\tage\tgender\thandedness\thearing\ttouch\n") !=
          std::string::npos);
    CHECK(fileOf(files, "bids/participants.tsv").find("\t34\ta | \"b\", c\tleft\tnone\tnone\n") != std::string::npos);
    CHECK(fileOf(files, "bids/participants.json").find("\"left\": \"left\"") != std::string::npos);
}

TEST_CASE("An answer in a log that its question does not allow is left out and told")
{
    TempFolder folder;
    const auto log = answeredOnce(folder);
    std::ifstream in(log, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    in.close();
    const auto put = [&](const std::string& from, const std::string& to)
    {
        const auto at = text.find(from);
        REQUIRE(at != std::string::npos);
        text.replace(at, from.size(), to);
    };
    put("\"age\":\"34\"", "\"age\":[3]");
    put("\"handedness\":\"left\"", "\"handedness\":\"third\"");
    std::ofstream(log, std::ios::binary) << text;
    const auto results = readResults(folder.path());
    REQUIRE(results);
    CHECK(results->items.size() == 3);
    REQUIRE(results->warnings.size() == 2);
    INFO(results->warnings[0]);
    CHECK(results->warnings[0].find("P001: age is '[3.0]', which is not a number") == 0);
}

TEST_CASE("A questionnaire comes before what is felt, once")
{
    Study study = *makeStudy("threshold", {});
    REQUIRE(addQuestionnaire(study, "demographics"));
    REQUIRE(addQuestionnaire(study, "music"));
    CHECK(study.blocks[0].name == "demographics");
    CHECK(study.blocks[1].name == "music");
    CHECK(study.blocks[2].name == "thresholds");
    CHECK(validate(study));
    CHECK_FALSE(addQuestionnaire(study, "music"));
    CHECK_FALSE(addQuestionnaire(study, "horoscope"));
}

TEST_CASE("What is wrong with a question is said where it is")
{
    const Study good = *makeStudy("questionnaire", {});
    const auto broken = [&](auto change)
    {
        Study study = good;
        change(study.blocks[0].items);
        const auto valid = validate(study);
        return valid ? std::string() : valid.error().where;
    };
    CHECK(broken([](auto&) {}).empty());
    CHECK(broken([](auto& items) { items[1].name = "age"; }) == "blocks[0].items[1].name");
    CHECK(broken([](auto& items) { items[0].question.clear(); }) == "blocks[0].items[0].question");
    CHECK(broken([](auto& items) { items[0].scale.high = -1.0; }) == "blocks[0].items[0].scale.high");
    CHECK(broken([](auto& items) { items[2].choices.clear(); }) == "blocks[0].items[2].choices");
    CHECK(broken([](auto& items) { items[2].choices.resize(1); }) == "blocks[0].items[2].choices");
    CHECK(broken([](auto& items) { items[2].choices[1].name = "right"; }) == "blocks[0].items[2].choices[1].name");
    CHECK(broken([](auto& items) { items.clear(); }) == "blocks[0].items");
    CHECK(broken([](auto& items) { items[0].kind = QuestionKind::likert; }) == "blocks[0].items[0].scale.step");
    Study nothing = good;
    nothing.blocks[1].task = Task::rating;
    nothing.blocks[1].items.clear();
    CHECK(validate(nothing).error().where == "stimuli");
}
