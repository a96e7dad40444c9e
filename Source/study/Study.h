#pragma once

// A study with participants: stimuli, groups, orders and questions.

#include "study/Exposure.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::study
{

/// A text in several languages: pairs of a code such as "en" and its text, in the order of the codes.
using Text = std::vector<std::pair<std::string, std::string>>;

/// Returns the text in `language`, else in English, else in the first language; empty for no text.
[[nodiscard]] std::string_view inLanguage(const Text& text, std::string_view language);

/// Task of a participant in a trial.
enum class Task
{
    rating,        ///< one number on a scale
    words,         ///< free description
    abx,           ///< which of two X is
    forcedChoice,  ///< which of two or three intervals is the other one: fixed differences
    staircase,     ///< the same, with differences that follow the answers
    multiStimulus, ///< MUSHRA: several at once on a scale, with hidden reference and anchors
    ranking,       ///< all in order
    similarity,    ///< similarity of two, on a scale
    sorting        ///< into as many heaps as there are kinds
};

/// Presentation of a stimulus with sound and touch.
enum class Presentation
{
    sound,       ///< the sound alone
    touch,       ///< the touch alone
    consecutive, ///< the sound, a pause, the touch (unimodal)
    simultaneous ///< both at once (bimodal), the touch later by `delay`
};

enum class Order
{
    random,      ///< a random order for each participant, by the seed
    latinSquare, ///< balanced for carry-over (Williams 1949)
    fixed        ///< as listed
};

/// A touch made of numbers: a tone with raised-cosine ends.
struct Tone
{
    double frequency = 160.0; ///< Hz, 1 to 1000
    double duration = 1.0;    ///< s, .01 to 60
    double fade = 0.05;       ///< s, each end; at most half of the duration
    double level = 0.0;       ///< dB re full drive, at most 0
    bool operator==(const Tone&) const = default;
};

/// A stimulus. At most one of clip, drive, tone and silence defines the haptic part; without any it is the translation
/// of the sound.
struct Stimulus
{
    std::string name;  ///< never shown to participants
    std::string sound; ///< file, from the study's folder; empty: nothing to hear
    std::string clip;  ///< clip or scene file
    std::string drive; ///< sound file that drives the actuator as it is
    std::optional<Tone> tone;
    std::optional<double> silence;                  ///< s without touch
    std::string method;                             ///< of translation; empty: a2vt
    std::optional<double> bands, breakpoints, bits; ///< of translation by a2vt
    double soundLevel = 0.0;                        ///< dB
    double touchLevel = 0.0;                        ///< dB
    /// If one of these is given, it sets the peak of the touch, and touchLevel (not the study's) is relative to it.
    std::optional<double> sensationLevel; ///< dB above the weakest drive that is felt, by the actuator's profile
    std::optional<double> acceleration;   ///< m/s2 that are felt, by the actuator's profile
    bool operator==(const Stimulus&) const = default;
};

struct Group
{
    std::string name;
    int size = 1; ///< participants
    bool operator==(const Group&) const = default;
};

/// The scale of ratings.
struct RatingScale
{
    double low = 0.0;
    double high = 10.0;
    double step = 0.0; ///< 0: continuous
    Text lowLabel;
    Text highLabel;
    bool operator==(const RatingScale&) const = default;
};

/// Variable of an adaptive procedure, and its unit.
enum class Variable
{
    level,           ///< of the touch, dB re full drive: is there anything at all?
    levelDifference, ///< from the reference, dB
    frequency,       ///< higher than the reference's, percent
    delay,           ///< of the touch after the sound, ms
    bands,           ///< of the translation; fewer are easier to tell from the reference
    breakpoints,     ///< per second and band, likewise
    bits             ///< of quantisation, likewise
};

enum class Procedure
{
    levitt,   ///< transformed up-down (Levitt 1971)
    questPlus ///< Bayesian, the most informative value next (Watson 2017)
};

/// Staircase that finds a threshold of its variable. Steps are in dB: of the level, or 20 log10 of the value of another
/// variable.
struct Adaptive
{
    Procedure procedure = Procedure::questPlus;
    Variable variable = Variable::level;
    double start = -20.0; ///< in the unit of the variable, as the next two
    double lowest = -60.0;
    double highest = 0.0;
    double step = 4.0;      ///< dB, at first
    double finalStep = 1.0; ///< dB, from the second reversal on
    int down = 2;           ///< right answers until it gets harder
    int reversals = 8;      ///< after which Levitt's procedure ends; all but the first two count
    int trials = 40;        ///< of QUEST+; the most of Levitt's
    bool operator==(const Adaptive&) const = default;
};

/// Returns the strength, dB, of a value of the variable: larger strengths are easier. It is the level, or 20 log10 of
/// the value, negated if smaller values are easier.
[[nodiscard]] double strengthOf(Variable variable, double value) noexcept;

/// The value of that strength.
[[nodiscard]] double valueOf(Variable variable, double strength) noexcept;

/// A part of the study: one task with all its stimuli.
struct Block
{
    std::string name;
    Task task = Task::rating;
    Presentation presentation = Presentation::simultaneous;
    Order order = Order::random;
    std::vector<std::string> groups;   ///< groups that do this block; none: all
    std::vector<std::string> stimuli;  ///< none: all
    std::vector<std::string> training; ///< first, without counting
    std::string reference;            ///< of abx, forcedChoice, staircase and multiStimulus: the stimulus of comparison
    std::vector<std::string> anchors; ///< of multiStimulus
    Text question;
    RatingScale scale;
    Adaptive adaptive;
    int intervals = 2;     ///< of forced choices: 2 or 3
    int repeats = 1;       ///< how often each stimulus comes
    int replays = -1;      ///< how often one may be played again; -1: any number
    double delay = 0.0;    ///< s of touch after sound, negative: before
    double pause = 0.5;    ///< pause between consecutive presentations, s
    bool masking = false;  ///< noise on the headphones while something is felt alone
    int breakAfter = 0;    ///< trials; 0: none
    bool feedback = false; ///< whether an answer was right
    bool operator==(const Block&) const = default;
};

/// Noise that keeps participants from hearing the actuator.
struct Masking
{
    double level = -30.0; ///< dB re full scale (RMS)
    double lowFrequency = 50.0;
    double highFrequency = 2000.0;
    bool operator==(const Masking&) const = default;
};

/// Limits for participants. Computed for each one, shown to the experimenter and never exceeded.
struct ExposureLimits
{
    ExposedPart part = ExposedPart::hand;
    double daily = actionValue(ExposedPart::hand); ///< m/s2, A(8)
    double minutes = 60; ///< of a session
    bool operator==(const ExposureLimits&) const = default;
};

struct Study
{
    std::string name;
    std::string description;
    std::uint64_t seed = 1; ///< of assignments and orders, up to 2^53
    std::vector<Group> groups;
    std::vector<Stimulus> stimuli;
    std::vector<Block> blocks;
    std::vector<std::string> comfort; ///< stimuli of the check before the first trial
    Text welcome, consent, goodbye;
    std::string profile;     ///< of the actuator: a shipped name or a file; empty: chosen in the program
    double touchLevel = 0.0; ///< dB, for everything
    double soundLevel = 0.0; ///< dB
    Masking masking;
    ExposureLimits limits;
    bool operator==(const Study&) const = default;
};

namespace studyLimits
{
inline constexpr std::size_t stimuli = 10'000, groups = 100, blocks = 100;
inline constexpr int participants = 100'000;
} // namespace studyLimits

/// The index of the stimulus of that name; npos when there is none.
[[nodiscard]] std::size_t stimulusNamed(const Study& study, std::string_view name);
inline constexpr std::size_t noStimulus = static_cast<std::size_t>(-1);

/// The stimuli of a block, as indices into the study's.
[[nodiscard]] std::vector<std::size_t> stimuliOf(const Study& study, const Block& block);

/// Whether the members of `group` do this block.
[[nodiscard]] bool isFor(const Block& block, std::string_view group);

/// Participants of all groups.
[[nodiscard]] int participantsOf(const Study& study);

/// Whether a task compares with a reference.
[[nodiscard]] bool needsReference(const Block& block);

} // namespace pacini::study
