#include "study/Questionnaires.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace pacini::study
{

namespace
{
constexpr std::array<Questionnaire, 2> shippedQuestionnaires{
    {{"demographics", "age, gender, handedness, hearing, feeling in the hands"},
     {"music", "years of lessons, hours of practice, instrument, listening"}}};

Text inThree(std::string english, std::string german, std::string japanese)
{
    return {{"de", std::move(german)}, {"en", std::move(english)}, {"ja", std::move(japanese)}};
}

Item questionItem(std::string name, QuestionKind kind, Text question, bool optional = false)
{
    Item item;
    item.name = std::move(name);
    item.kind = kind;
    item.question = std::move(question);
    item.optional = optional;
    return item;
}

Item askedNumber(std::string name, Text question, double low, double high, double step)
{
    Item item = questionItem(std::move(name), QuestionKind::number, std::move(question));
    item.scale = {low, high, step, {}, {}};
    return item;
}

Item askedChoice(std::string name, Text question, std::vector<ItemChoice> choices)
{
    Item item = questionItem(std::move(name), QuestionKind::choice, std::move(question));
    item.choices = std::move(choices);
    return item;
}

Item askedAgreement(std::string name, Text question)
{
    Item item = questionItem(std::move(name), QuestionKind::likert, std::move(question));
    item.scale = {1.0, 5.0, 1.0, inThree("does not apply at all", "trifft gar nicht zu", "まったく当てはまらない"),
                  inThree("applies completely", "trifft voll zu", "完全に当てはまる")};
    return item;
}

std::vector<Item> demographics()
{
    const ItemChoice none{"none", inThree("none", "keine", "なし")};
    return {askedNumber("age", inThree("How old are you (years)?", "Wie alt bist du (Jahre)?", "年齢（歳）"), 5.0,
                        120.0, 1.0),
            questionItem("gender", QuestionKind::text,
                         inThree("What is your gender? In your own words, or leave it empty.",
                                 "Was ist dein Geschlecht? In eigenen Worten, oder leer lassen.",
                                 "性別を自由にお書きください。空欄でもかまいません。"),
                         true),
            askedChoice("handedness",
                        inThree("Which hand do you write with?", "Mit welcher Hand schreibst du?",
                                "どちらの手で字を書きますか。"),
                        {{"right", inThree("right", "rechts", "右")},
                         {"left", inThree("left", "links", "左")},
                         {"both", inThree("both", "beide", "両方")}}),
            askedChoice("hearing",
                        inThree("Do you know of a hearing impairment?", "Ist dir eine Hörminderung bekannt?",
                                "聴力の低下を知っていますか。"),
                        {none,
                         {"impaired", inThree("yes", "ja", "はい")},
                         {"aided", inThree("yes, with a hearing aid or implant", "ja, mit Hörgerät oder Implantat",
                                           "はい、補聴器または人工内耳を使用")},
                         {"unknown", inThree("I do not know", "weiß ich nicht", "わからない")}}),
            askedChoice("touch",
                        inThree("Do you know of less feeling in your hands or arms?",
                                "Ist dir ein vermindertes Gefühl in Händen oder Armen bekannt?",
                                "手や腕の感覚が弱いと感じることがありますか。"),
                        {none,
                         {"reduced", inThree("yes", "ja", "はい")},
                         {"unknown", inThree("I do not know", "weiß ich nicht", "わからない")}})};
}

std::vector<Item> music()
{
    return {askedNumber("lessons",
                        inThree("How many years of lessons did you have on an instrument or in singing?",
                                "Wie viele Jahre hattest du Unterricht auf einem Instrument oder im Gesang?",
                                "楽器または歌のレッスンを何年受けましたか。"),
                        0.0, 100.0, 0.5),
            askedNumber("theory",
                        inThree("How many years were you taught music theory, outside of school?",
                                "Wie viele Jahre hattest du Unterricht in Musiktheorie, außerhalb der Schule?",
                                "学校以外で音楽理論を何年学びましたか。"),
                        0.0, 100.0, 0.5),
            askedNumber("practice",
                        inThree("How many hours a week do you play or sing at present?",
                                "Wie viele Stunden pro Woche spielst oder singst du zurzeit?",
                                "現在、週に何時間演奏または歌唱をしますか。"),
                        0.0, 168.0, 0.5),
            askedNumber("listening",
                        inThree("How many hours a week do you listen to music attentively?",
                                "Wie viele Stunden pro Woche hörst du aufmerksam Musik?",
                                "週に何時間、注意して音楽を聴きますか。"),
                        0.0, 168.0, 0.5),
            questionItem("instrument", QuestionKind::text,
                         inThree("Which instrument do you play best? Leave it empty for none.",
                                 "Welches Instrument spielst du am besten? Für keines leer lassen.",
                                 "最も得意な楽器は何ですか。なければ空欄にしてください。"),
                         true),
            askedAgreement("rhythm", inThree("It is easy for me to tap along with a rhythm.",
                                             "Es fällt mir leicht, einen Rhythmus mitzuklopfen.",
                                             "リズムに合わせて叩くのは簡単です。")),
            askedAgreement("sounds", inThree("At work or as a hobby I deal with sound or its technology.",
                                             "Ich befasse mich beruflich oder als Hobby mit Klang oder Tontechnik.",
                                             "仕事または趣味で音や音響技術に携わっています。"))};
}
} // namespace

std::span<const Questionnaire> questionnaires() noexcept
{
    return shippedQuestionnaires;
}

Result<void> addQuestionnaire(Study& study, std::string_view name)
{
    if (std::none_of(shippedQuestionnaires.begin(), shippedQuestionnaires.end(),
                     [&](const Questionnaire& one) { return one.name == name; }))
        return Error{ErrorCode::invalidArgument, "questionnaire", fmt::format("'{}' is not known", name)};
    if (std::any_of(study.blocks.begin(), study.blocks.end(), [&](const Block& one) { return one.name == name; }))
        return Error{ErrorCode::invalidArgument, "questionnaire", fmt::format("'{}' is in the study already", name)};
    Block block;
    block.name = std::string(name);
    block.task = Task::questionnaire;
    block.question = inThree("Some questions about you", "Einige Fragen zu dir", "あなたについての質問");
    block.items = name == "music" ? music() : demographics();
    study.blocks.insert(std::find_if(study.blocks.begin(), study.blocks.end(), hasStimuli), std::move(block));
    return {};
}

} // namespace pacini::study
