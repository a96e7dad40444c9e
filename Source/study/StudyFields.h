#pragma once

// Field lists of a study in JSON, which its reader and its writer follow.

#include "io/Fields.h"
#include "io/SceneFields.h"
#include "study/Study.h"

#include <array>
#include <type_traits>

namespace pacini::study::fields
{

inline constexpr std::array<Choice<Task>, 14> tasks{{{"rating", Task::rating},
                                                     {"words", Task::words},
                                                     {"abx", Task::abx},
                                                     {"forcedChoice", Task::forcedChoice},
                                                     {"staircase", Task::staircase},
                                                     {"multiStimulus", Task::multiStimulus},
                                                     {"ranking", Task::ranking},
                                                     {"similarity", Task::similarity},
                                                     {"sorting", Task::sorting},
                                                     {"questionnaire", Task::questionnaire},
                                                     {"place", Task::place},
                                                     {"side", Task::side},
                                                     {"count", Task::count},
                                                     {"which", Task::which}}};
inline constexpr std::array<Choice<QuestionKind>, 4> questionKinds{{{"text", QuestionKind::text},
                                                                    {"number", QuestionKind::number},
                                                                    {"choice", QuestionKind::choice},
                                                                    {"likert", QuestionKind::likert}}};
inline constexpr std::array<Choice<Mass>, 3> masses{
    {{"definite", Mass::definite}, {"complex", Mass::complex}, {"varying", Mass::varying}}};
inline constexpr std::array<Choice<Facture>, 3> factures{
    {{"continuous", Facture::continuous}, {"impulse", Facture::impulse}, {"iterative", Facture::iterative}}};
inline constexpr std::array<Choice<Presentation>, 4> presentations{{{"sound", Presentation::sound},
                                                                    {"touch", Presentation::touch},
                                                                    {"consecutive", Presentation::consecutive},
                                                                    {"simultaneous", Presentation::simultaneous}}};
inline constexpr std::array<Choice<Order>, 3> orders{
    {{"random", Order::random}, {"latinSquare", Order::latinSquare}, {"fixed", Order::fixed}}};
inline constexpr std::array<Choice<Variable>, 7> variables{{{"level", Variable::level},
                                                            {"levelDifference", Variable::levelDifference},
                                                            {"frequency", Variable::frequency},
                                                            {"delay", Variable::delay},
                                                            {"bands", Variable::bands},
                                                            {"breakpoints", Variable::breakpoints},
                                                            {"bits", Variable::bits}}};
inline constexpr std::array<Choice<Procedure>, 2> procedures{
    {{"levitt", Procedure::levitt}, {"questPlus", Procedure::questPlus}}};

inline constexpr std::array<Choice<ExposedPart>, 2> exposedParts{
    {{"hand", ExposedPart::hand}, {"wholeBody", ExposedPart::wholeBody}}};

inline constexpr std::size_t mostNames = studyLimits::stimuli;

template <typename AnyTone, typename Visitor>
void visitTone(AnyTone& tone, Visitor& visitor)
{
    visitNumbers(visitor, Need::usual, "frequency", tone.frequency, "duration", tone.duration, "fade", tone.fade,
                 "level", tone.level);
}

template <typename AnyStimulus, typename Visitor>
void visitStimulus(AnyStimulus& stimulus, Visitor& visitor)
{
    visitor.text("name", stimulus.name);
    visitor.optionalText("sound", stimulus.sound);
    visitor.optionalText("clip", stimulus.clip);
    visitor.optionalText("drive", stimulus.drive);
    visitor.optionalObject("tone", stimulus.tone, [&](auto& tone) { visitTone(tone, visitor); });
    visitor.optionalNumber("silence", stimulus.silence);
    visitor.textList("mix", stimulus.mix, studyLimits::events);
    visitor.optionalText("method", stimulus.method);
    visitor.optionalNumber("bands", stimulus.bands);
    visitor.optionalNumber("breakpoints", stimulus.breakpoints);
    visitor.optionalNumber("bits", stimulus.bits);
    visitor.number("soundLevel", stimulus.soundLevel, Need::usual);
    visitor.number("touchLevel", stimulus.touchLevel, Need::usual);
    visitor.optionalNumber("sensationLevel", stimulus.sensationLevel);
    visitor.optionalNumber("acceleration", stimulus.acceleration);
    visitor.optionalObject("place", stimulus.place,
                           [&](auto& place)
                           {
                               visitor.number("position", place.position, Need::usual);
                               visitor.choice("by", place.by, sceneFields::panLaws, Need::usual);
                           });
    visitor.optionalObject("object", stimulus.object,
                           [&](auto& object)
                           {
                               visitor.choice("mass", object.mass, masses, Need::required);
                               visitor.choice("facture", object.facture, factures, Need::required);
                           });
    visitor.textList("tags", stimulus.tags, mostNames);
    visitor.texts("label", stimulus.label);
}

template <typename AnyScale, typename Visitor>
void visitScale(AnyScale& scale, Visitor& visitor)
{
    visitNumbers(visitor, Need::usual, "low", scale.low, "high", scale.high, "step", scale.step);
    visitor.texts("lowLabel", scale.lowLabel);
    visitor.texts("highLabel", scale.highLabel);
}

template <typename AnyAdaptive, typename Visitor>
void visitAdaptive(AnyAdaptive& adaptive, Visitor& visitor)
{
    visitor.choice("procedure", adaptive.procedure, procedures, Need::usual);
    visitor.choice("variable", adaptive.variable, variables, Need::usual);
    visitNumbers(visitor, Need::usual, "start", adaptive.start, "lowest", adaptive.lowest, "highest", adaptive.highest,
                 "step", adaptive.step, "finalStep", adaptive.finalStep);
    visitor.integer("down", adaptive.down, "must be a whole number, 1 to 4");
    visitor.integer("reversals", adaptive.reversals, "must be a whole number, 2 to 100");
    visitor.integer("trials", adaptive.trials, "must be a whole number, 5 to 1000");
}

template <typename AnyItem, typename Visitor>
void visitItem(AnyItem& item, Visitor& visitor)
{
    visitor.text("name", item.name);
    visitor.choice("kind", item.kind, questionKinds, Need::required);
    visitor.texts("question", item.question);
    visitor.list("choices", item.choices, studyLimits::choices, "choices",
                 [&](auto& choice)
                 {
                     visitor.text("name", choice.name);
                     visitor.texts("text", choice.text);
                 });
    visitor.object("scale", item.scale, Need::optional, [&](auto& scale) { visitScale(scale, visitor); });
    visitor.truth("optional", item.optional);
}

template <typename AnyBlock, typename Visitor>
void visitBlock(AnyBlock& block, Visitor& visitor)
{
    visitor.text("name", block.name);
    visitor.choice("task", block.task, tasks, Need::required);
    visitor.choice("presentation", block.presentation, presentations, Need::usual);
    visitor.choice("order", block.order, orders, Need::usual);
    visitor.textList("groups", block.groups, studyLimits::groups);
    visitor.textList("stimuli", block.stimuli, mostNames);
    visitor.textList("training", block.training, mostNames);
    visitor.optionalText("reference", block.reference);
    visitor.textList("anchors", block.anchors, mostNames);
    visitor.texts("question", block.question);
    visitor.object("scale", block.scale, Need::optional, [&](auto& scale) { visitScale(scale, visitor); });
    visitor.object("adaptive", block.adaptive, Need::optional,
                   [&](auto& adaptive) { visitAdaptive(adaptive, visitor); });
    visitor.integer("intervals", block.intervals, "must be 2 or 3");
    visitor.integer("repeats", block.repeats, "must be a whole number, 1 to 1000");
    visitor.integer("replays", block.replays, "must be a whole number, -1 (any) to 1000");
    visitor.number("delay", block.delay, Need::usual);
    visitor.number("pause", block.pause, Need::usual);
    visitor.truth("masking", block.masking);
    visitor.integer("breakAfter", block.breakAfter, "must be a whole number, 0 (none) to 1000");
    visitor.truth("feedback", block.feedback);
    visitor.list("items", block.items, studyLimits::items, "questions", [&](auto& item) { visitItem(item, visitor); });
}

/// Shows `visitor` (FieldsReader or FieldsWriter) all entries after format and version, in the order of the file.
template <typename AnyStudy, typename Visitor>
void visitStudy(AnyStudy& study, Visitor& visitor)
{
    visitor.text("name", study.name);
    visitor.optionalText("description", study.description);
    visitor.list("groups", study.groups, studyLimits::groups, "groups",
                 [&](auto& group)
                 {
                     visitor.text("name", group.name);
                     visitor.integer("size", group.size, "must be a whole number, 1 to 100000");
                 });
    visitor.list("stimuli", study.stimuli, studyLimits::stimuli, "stimuli",
                 [&](auto& stimulus) { visitStimulus(stimulus, visitor); });
    visitor.list("blocks", study.blocks, studyLimits::blocks, "blocks",
                 [&](auto& block) { visitBlock(block, visitor); });
    visitor.textList("comfort", study.comfort, mostNames);
    visitor.texts("welcome", study.welcome);
    visitor.texts("consent", study.consent);
    visitor.texts("goodbye", study.goodbye);
    visitor.optionalText("profile", study.profile);
    visitor.number("touchLevel", study.touchLevel, Need::usual);
    visitor.number("soundLevel", study.soundLevel, Need::usual);
    visitor.object("masking", study.masking, Need::usual,
                   [&](auto& masking)
                   {
                       visitNumbers(visitor, Need::usual, "level", masking.level, "lowFrequency", masking.lowFrequency,
                                    "highFrequency", masking.highFrequency);
                   });
    visitor.object("limits", study.limits, Need::usual,
                   [&](auto& limits)
                   {
                       visitor.choice("part", limits.part, exposedParts, Need::usual);
                       if constexpr (!std::is_const_v<std::remove_reference_t<decltype(limits)>>)
                           limits.daily = actionValue(limits.part); // unless the study has its own
                       visitor.number("daily", limits.daily, Need::usual);
                       visitor.number("minutes", limits.minutes, Need::usual);
                       visitor.optionalNumber("soundLevel", limits.soundLevel);
                       visitor.optionalNumber("soundDaily", limits.soundDaily);
                       visitor.optionalNumber("loudness", limits.loudness);
                   });
    visitor.object("row", study.row, Need::optional,
                   [&](auto& row)
                   {
                       visitor.integer("actuators", row.actuators, "must be a whole number, 1 to 8");
                       visitor.number("delay", row.delay, Need::usual);
                   });
    visitor.optionalObject("calibration", study.calibration,
                           [&](auto& calibration)
                           {
                               visitor.number("tone", calibration.tone, Need::usual);
                               visitor.number("level", calibration.level, Need::required);
                           });
}

} // namespace pacini::study::fields
