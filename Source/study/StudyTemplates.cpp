#include "study/StudyTemplates.h"

#include "study/Questionnaires.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <utility>

namespace pacini::study
{

namespace
{
constexpr std::size_t mostEvents = 4;
constexpr std::array<StudyTemplate, 12> templates{
    {{"coherence", "Sound and touch together",
      "how well sound and touch belong together: three groups, free words and ratings (Weber 2020)", 2},
     {"words", "Free description", "free description of what is felt and heard", 1},
     {"mushra", "MUSHRA: translations side by side",
      "quality of translations beside each other, with hidden reference and anchor", 1},
     {"abx", "ABX: coarse or full", "can a translation with fewer breakpoints be told from the full one?", 1},
     {"jnd", "Just noticeable differences", "just noticeable differences of level and frequency of a touch", 0, 0},
     {"compression", "Bands and points needed",
      "how few bands and points are not told from the full translation, felt alone and with its sound", 1},
     {"threshold", "Threshold of touch", "weakest touch that is felt, at eight frequencies", 0, 0},
     {"similarity", "Likeness of touches", "how alike touches are, pair by pair, for a map of them", 3},
     {"ranking", "Order of preference", "touches in order of preference", 2},
     {"place", "Place between actuators",
      "where a touch between two actuators is felt that is placed by level, delay or both", 0, 0},
     {"events", "Events at once", "how many touches at once are told apart, and which", 0, mostEvents, 2},
     {"questionnaire", "Questionnaire", "age, handedness, hearing and musical experience", 0, 0}}};

// The octave from 31.5 to 500 Hz in halves, around the 250 Hz where Pacinian corpuscles feel best.
constexpr std::array<double, 8> thresholdFrequencies{31.5, 45.0, 63.0, 90.0, 125.0, 180.0, 250.0, 355.0};

Text said(std::string english, std::string german, std::string japanese)
{
    return {{"de", std::move(german)}, {"en", std::move(english)}, {"ja", std::move(japanese)}};
}

Study begun(std::string_view name)
{
    Study study;
    study.name = std::string(name);
    study.groups = {{"all", 12}};
    study.welcome =
        said("Thank you for taking part. There are no wrong answers: it is about what you feel and hear. You may "
             "stop at any time with the Escape key.",
             "Vielen Dank, dass du teilnimmst. Es gibt keine falschen Antworten: Es geht darum, was du fühlst "
             "und hörst. Du kannst jederzeit mit der Escape-Taste abbrechen.",
             "ご参加ありがとうございます。正解や不正解はありません。感じたこと、聞こえたことをお答えください。Escape "
             "キーでいつでも中止できます。");
    study.consent = said(
        "I take part of my own free will and may stop at any time without giving a reason. My answers are kept "
        "under a pseudonym.",
        "Ich nehme freiwillig teil und kann jederzeit ohne Angabe von Gründen abbrechen. Meine Antworten "
        "werden unter einem Pseudonym gespeichert.",
        "私は自分の意思で参加し、理由を述べずにいつでも中止できることを理解しています。回答は仮名で保存されます。");
    study.goodbye =
        said("That was all. Thank you!", "Das war alles. Vielen Dank!", "これで終わりです。ありがとうございました。");
    return study;
}

std::vector<std::string> addSounds(Study& study, const std::vector<std::string>& sounds)
{
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const std::string& sound : sounds)
    {
        const std::string stem = std::filesystem::path(sound).stem().string();
        std::string name = stem;
        for (int i = 2; !taken.insert(name).second; ++i)
            name = fmt::format("{} {}", stem, i);
        Stimulus stimulus;
        stimulus.name = name;
        stimulus.sound = sound;
        study.stimuli.push_back(std::move(stimulus));
        names.push_back(std::move(name));
    }
    return names;
}

Stimulus& addTone(Study& study, std::string name, double frequency, double level, double duration = 0.6)
{
    Stimulus stimulus;
    stimulus.name = std::move(name);
    stimulus.tone = Tone{frequency, duration, 0.05, level};
    return study.stimuli.emplace_back(std::move(stimulus));
}

Block block(std::string name, Task task, Presentation presentation, Text question)
{
    Block made;
    made.name = std::move(name);
    made.task = task;
    made.presentation = presentation;
    made.question = std::move(question);
    return made;
}

const Text describe =
    said("Which words describe what you perceive? Say how it is, not what it comes from.",
         "Welche Worte beschreiben, was du wahrnimmst? Sag, wie es ist, nicht, woher es kommt.",
         "感じたものをどのような言葉で表しますか。何から生じたかではなく、どのようであるかをお答えください。");

Text coherenceLow()
{
    return said("not at all", "gar nicht", "まったく合わない");
}
Text coherenceHigh()
{
    return said("perfectly", "vollkommen", "完全に合う");
}

Study coherence(const std::vector<std::string>& sounds)
{
    Study study = begun("coherence");
    study.description =
        "Sound and touch made of it: described in words, then rated for how well they belong together. One "
        "group hears and one feels before both rate one after the other; one perceives both at once.";
    study.groups = {{"A", 11}, {"B", 11}, {"C", 11}};
    addSounds(study, sounds);
    const auto add =
        [&](std::string name, Task task, Presentation presentation, std::vector<std::string> groups, Text question)
    {
        Block made = block(std::move(name), task, presentation, std::move(question));
        made.groups = std::move(groups);
        made.masking = true; // where something is felt alone
        made.scale.lowLabel = coherenceLow();
        made.scale.highLabel = coherenceHigh();
        study.blocks.push_back(std::move(made));
    };
    add("words of sounds", Task::words, Presentation::sound, {"A"}, describe);
    add("words of touches", Task::words, Presentation::touch, {"B"}, describe);
    add("words of both", Task::words, Presentation::simultaneous, {"C"}, describe);
    add("coherence, one after the other", Task::rating, Presentation::consecutive, {"A", "B"},
        said("How well do the sound and the touch that follows belong together?",
             "Wie gut passen der Klang und die darauf folgende Berührung zusammen?",
             "音と、それに続く触覚はどのくらい合っていますか。"));
    add("coherence, at once", Task::rating, Presentation::simultaneous, {"C"},
        said("How well do the sound and the touch belong together?", "Wie gut passen Klang und Berührung zusammen?",
             "音と触覚はどのくらい合っていますか。"));
    return study;
}

Study words(const std::vector<std::string>& sounds)
{
    Study study = begun("words");
    addSounds(study, sounds);
    study.blocks.push_back(block("words", Task::words, Presentation::simultaneous, describe));
    return study;
}

/// Each sound is a page: its own translation as the hidden reference, coarser ones, and a plain vibration as the
/// anchor.
Study mushra(const std::vector<std::string>& sounds)
{
    Study study = begun("mushra");
    study.description = "Each sound is a page of its own.";
    for (const std::string& name : addSounds(study, sounds))
    {
        const std::string sound = study.stimuli[stimulusNamed(study, name)].sound;
        const auto variant = [&](const std::string& kind, auto change)
        {
            Stimulus made;
            made.name = name + ", " + kind;
            made.sound = sound;
            change(made);
            study.stimuli.push_back(made);
            return made.name;
        };
        Block page = block(name, Task::multiStimulus, Presentation::simultaneous,
                           said("How well does each touch match the sound?", "Wie gut passt jede Berührung zum Klang?",
                                "それぞれの触覚は音とどのくらい合っていますか。"));
        page.reference = name;
        page.stimuli = {variant("4 bands", [](Stimulus& one) { one.bands = 4; }),
                        variant("1 band", [](Stimulus& one) { one.bands = 1; }),
                        variant("3 points per second", [](Stimulus& one) { one.breakpoints = 3; })};
        page.anchors = {variant("envelope", [](Stimulus& one) { one.method = "hapticgen"; })};
        page.scale = {0.0, 100.0, 1.0, said("bad", "schlecht", "悪い"),
                      said("excellent", "ausgezeichnet", "非常に良い")};
        study.blocks.push_back(std::move(page));
    }
    return study;
}

Study abx(const std::vector<std::string>& sounds)
{
    Study study = begun("abx");
    for (const std::string& name : addSounds(study, sounds))
    {
        Stimulus coarse = study.stimuli[stimulusNamed(study, name)];
        coarse.name = name + ", 3 points per second";
        coarse.breakpoints = 3;
        study.stimuli.push_back(coarse);
        Block made = block(name, Task::abx, Presentation::touch,
                           said("Is the third like the first or like the second?",
                                "Ist die dritte Berührung wie die erste oder wie die zweite?",
                                "3番目は1番目と2番目のどちらと同じですか。"));
        made.reference = name;
        made.stimuli = {coarse.name};
        made.repeats = 16; // 12 right of 16 are below .05 by guessing
        made.masking = true;
        study.blocks.push_back(std::move(made));
    }
    return study;
}

Study jnd()
{
    Study study = begun("jnd");
    study.description = "Differences from a tone of 160 Hz at -12 dB that are noticed in 75 % of the cases.";
    addTone(study, "160 Hz", 160.0, -12.0);
    addTone(study, "160 Hz, changed", 160.0, -12.0);
    const auto add =
        [&](std::string name, Variable variable, double start, double lowest, double highest, Text question)
    {
        Block made = block(std::move(name), Task::staircase, Presentation::touch, std::move(question));
        made.reference = "160 Hz";
        made.stimuli = {"160 Hz, changed"};
        made.masking = true;
        made.adaptive.variable = variable;
        made.adaptive.start = start;
        made.adaptive.lowest = lowest;
        made.adaptive.highest = highest;
        study.blocks.push_back(std::move(made));
    };
    add("level", Variable::levelDifference, 6.0, 0.3, 10.0,
        said("Which one was stronger?", "Welche war stärker?", "どちらが強かったですか。"));
    add("frequency", Variable::frequency, 50.0, 2.0, 100.0,
        said("Which one was higher?", "Welche war höher?", "どちらが高かったですか。"));
    return study;
}

/// Each sound is compared with its own translation of fewer bands or points, which is also how many bytes it takes.
Study compression(const std::vector<std::string>& sounds)
{
    Study study = begun("compression");
    study.description =
        "How few bands and breakpoints of a translation are not told from the full one, felt alone and with "
        "its sound. Bytes follow from them: pacini info tells those of a clip.";
    for (const std::string& name : addSounds(study, sounds))
    {
        Stimulus coarse = study.stimuli[stimulusNamed(study, name)];
        coarse.name = name + ", coarser";
        study.stimuli.push_back(coarse);
        const auto add =
            [&](std::string kind, Variable variable, double lowest, double highest, Presentation presentation)
        {
            Block made = block(name + ", " + std::move(kind), Task::staircase, presentation,
                               said("Which one is unlike the other two?", "Welche ist anders als die anderen beiden?",
                                    "ほかの2つと違うのはどれですか。"));
            made.reference = name;
            made.stimuli = {coarse.name};
            made.intervals = 3;
            made.pause = 0.3;
            made.masking = presentation == Presentation::touch;
            made.adaptive.variable = variable;
            made.adaptive.start = 2.0 * lowest;
            made.adaptive.lowest = lowest;
            made.adaptive.highest = highest;
            made.adaptive.trials = 20;
            study.blocks.push_back(std::move(made));
        };
        for (const auto& [alone, presentation] :
             {std::pair(", felt", Presentation::touch), std::pair(", felt and heard", Presentation::simultaneous)})
        {
            add(std::string("bands") + alone, Variable::bands, 1.0, 12.0, presentation);
            add(std::string("breakpoints") + alone, Variable::breakpoints, 1.0, 40.0, presentation);
        }
    }
    return study;
}

Study threshold()
{
    Study study = begun("threshold");
    study.description = "The weakest tone that is felt, at eight frequencies; some nine minutes.";
    Block made = block("thresholds", Task::staircase, Presentation::touch,
                       said("In which one did you feel something?", "In welchem hast du etwas gefühlt?",
                            "どの区間で何かを感じましたか。"));
    for (const double frequency : thresholdFrequencies)
        made.stimuli.push_back(addTone(study, fmt::format("{} Hz", frequency), frequency, 0.0, 0.4).name);
    made.masking = true;
    made.adaptive = {Procedure::questPlus, Variable::level, -30.0, -60.0, 0.0, 8.0, 2.0, 2, 8, 15};
    // Of 15 trials with three intervals half of the thresholds come within 1.2 dB, nine tenths within 4; with two it
    // would be 1.8 and 6.
    made.intervals = 3;
    made.pause = 0.2;
    study.blocks.push_back(std::move(made));
    return study;
}

Study similarity(const std::vector<std::string>& sounds)
{
    Study study = begun("similarity");
    addSounds(study, sounds);
    Block made = block("similarity", Task::similarity, Presentation::touch,
                       said("How different are these two touches?", "Wie verschieden sind diese beiden Berührungen?",
                            "この2つの触覚はどのくらい違いますか。"));
    made.scale = {0.0, 10.0, 0.0, said("the same", "gleich", "同じ"),
                  said("completely different", "völlig verschieden", "まったく違う")};
    made.masking = true;
    study.blocks.push_back(std::move(made));
    return study;
}

Study ranking(const std::vector<std::string>& sounds)
{
    Study study = begun("ranking");
    addSounds(study, sounds);
    Block made = block("ranking", Task::ranking, Presentation::simultaneous,
                       said("Put them in order, what you like best first.",
                            "Bring sie in eine Reihenfolge, was dir am besten gefällt, zuerst.",
                            "最も好きなものから順に並べてください。"));
    study.blocks.push_back(std::move(made));
    return study;
}

/// A short touch at four places between two actuators, each by level, delay and both.
Study placed()
{
    Study study = begun("place");
    study.description = "Where a touch between two actuators is felt that is placed by level, by delay or by both.";
    study.row.actuators = 2;
    const auto stimulusAt = [&](double position, PanLaw by, std::string_view name)
    {
        // A short fade: delays are told by the onset.
        Stimulus& one = addTone(study, fmt::format("{:.0f} %, {}", 100.0 * position, name), 160.0, -6.0, 0.2);
        one.tone->fade = 0.005;
        one.place = Place{position, by};
        return one.name;
    };
    Block where = block("place", Task::place, Presentation::touch,
                        said("Where did you feel it?", "Wo hast du es gefühlt?", "どこで感じましたか。"));
    where.scale = {0.0, 100.0, 0.0, said("left", "links", "左"), said("right", "rechts", "右")};
    where.masking = true;
    where.repeats = 4;
    Block side = block("side", Task::side, Presentation::touch,
                       said("Was it left or right of the middle?", "War es links oder rechts der Mitte?",
                            "中央より左でしたか、右でしたか。"));
    side.masking = true;
    side.repeats = 8;
    for (const auto& [by, name] : {std::pair(PanLaw::constantPower, "level"), std::pair(PanLaw::delay, "delay"),
                                   std::pair(PanLaw::both, "both")})
        // At the ends and in the middle both is like one of the others.
        for (const double position : {0.1, 0.3, 0.7, 0.9})
        {
            where.stimuli.push_back(stimulusAt(position, by, name));
            if (position == 0.3 || position == 0.7)
                side.stimuli.push_back(where.stimuli.back());
        }
    study.comfort = {where.stimuli.front()};
    study.blocks = {std::move(where), std::move(side)};
    return study;
}

/// Two to four events, alone and in all combinations: the translations of sounds, or four tones.
Study simultaneous(const std::vector<std::string>& sounds)
{
    constexpr double quieter = -12.0; // dB: four at once stay below full drive
    Study study = begun("events");
    study.description = "How many touches at once are told apart, and which: each alone and in all combinations.";
    std::vector<std::string> events;
    if (!sounds.empty())
        events = addSounds(study, sounds);
    else
        for (const double frequency : {40.0, 90.0, 180.0, 320.0})
            events.push_back(addTone(study, fmt::format("{} Hz", frequency), frequency, 0.0, 1.0).name);
    for (std::size_t i = 0; i < events.size(); ++i)
    {
        study.stimuli[i].touchLevel = quieter;
        const std::string letter(1, static_cast<char>('A' + i));
        study.stimuli[i].label = said(letter, letter, letter);
    }
    std::vector<std::string> all = events;
    for (unsigned chosen = 1; chosen < 1u << events.size(); ++chosen)
    {
        Stimulus mix;
        for (std::size_t i = 0; i < events.size(); ++i)
            if ((chosen >> i & 1u) != 0)
                mix.mix.push_back(events[i]);
        if (mix.mix.size() < 2)
            continue;
        mix.name = fmt::format("{}", fmt::join(mix.mix, " + "));
        all.push_back(mix.name);
        study.stimuli.push_back(std::move(mix));
    }
    const auto add = [&](std::string name, Task task, Text question)
    {
        Block made = block(std::move(name), task, Presentation::touch, std::move(question));
        made.training = events;
        made.stimuli = all;
        made.masking = true;
        made.repeats = 3;
        study.blocks.push_back(std::move(made));
    };
    add("count", Task::count,
        said("How many different touches did you feel at once?",
             "Wie viele verschiedene Berührungen hast du gleichzeitig gefühlt?",
             "同時にいくつの異なる触覚を感じましたか。"));
    add("which", Task::which,
        said("Which touches did you feel?", "Welche Berührungen hast du gefühlt?", "どの触覚を感じましたか。"));
    return study;
}

Study asked()
{
    Study study = begun("questionnaire");
    for (const Questionnaire& one : questionnaires())
        (void)addQuestionnaire(study, one.name);
    return study;
}
} // namespace

std::span<const StudyTemplate> studyTemplates() noexcept
{
    return templates;
}

std::string soundsOf(const StudyTemplate& one)
{
    if (one.mostSounds == StudyTemplate::any)
        return fmt::format("{} or more", one.fewestSounds);
    return one.mostSounds == 0 ? "none" : fmt::format("none, or {} to {}", one.fewestOwn, one.mostSounds);
}

Result<Study> makeStudy(std::string_view name, const std::vector<std::string>& sounds)
{
    const StudyTemplate* wanted = nullptr;
    for (const StudyTemplate& one : templates)
        if (one.name == name)
            wanted = &one;
    if (wanted == nullptr)
        return Error{ErrorCode::invalidArgument, "template", fmt::format("'{}' is not known", name)};
    if (sounds.size() < wanted->fewestSounds)
        return Error{ErrorCode::invalidArgument, "sounds",
                     fmt::format("{} needs {} at least, such as pacini study new {} --template {} sounds/", name,
                                 wanted->fewestSounds, name, name)};
    if (sounds.size() > wanted->mostSounds || (!sounds.empty() && sounds.size() < wanted->fewestOwn))
    {
        std::string message = fmt::format("{} takes {} sounds, but {} {} given;", name,
                                          wanted->mostSounds == 0 ? std::string("no") : soundsOf(*wanted),
                                          sounds.size(), sounds.size() == 1 ? "was" : "were");
        std::string_view before = " choose as many, or another template: ";
        for (const StudyTemplate& one : templates)
            if (one.mostSounds > 0)
                message += fmt::format("{}{} ({})", std::exchange(before, ", "), one.name, soundsOf(one));
        return Error{ErrorCode::invalidArgument, "sounds", std::move(message)};
    }
    if (name == "coherence")
        return coherence(sounds);
    if (name == "words")
        return words(sounds);
    if (name == "mushra")
        return mushra(sounds);
    if (name == "abx")
        return abx(sounds);
    if (name == "jnd")
        return jnd();
    if (name == "compression")
        return compression(sounds);
    if (name == "threshold")
        return threshold();
    if (name == "similarity")
        return similarity(sounds);
    if (name == "place")
        return placed();
    if (name == "events")
        return simultaneous(sounds);
    if (name == "questionnaire")
        return asked();
    return ranking(sounds);
}

Result<void> setGroups(Study& study, const std::vector<Group>& groups)
{
    if (groups.empty())
        return Error{ErrorCode::invalidArgument, "--group", "is missing: a study has one group at least"};
    const std::vector<Group> before = std::exchange(study.groups, groups);
    // The group of the template whose blocks the group at this place does.
    const auto roleOf = [&](std::size_t place) -> const std::string&
    {
        for (const Group& one : before)
            if (one.name == groups[place].name)
                return one.name;
        return before[place % before.size()].name;
    };
    std::erase_if(study.blocks,
                  [&](Block& block)
                  {
                      if (block.groups.empty())
                          return false; // for all
                      const std::vector<std::string> roles = std::exchange(block.groups, {});
                      for (std::size_t i = 0; i < groups.size(); ++i)
                          if (std::find(roles.begin(), roles.end(), roleOf(i)) != roles.end())
                              block.groups.push_back(groups[i].name);
                      return block.groups.empty();
                  });
    return {};
}

} // namespace pacini::study
