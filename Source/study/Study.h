#pragma once

// A study with participants: stimuli, groups, orders and questions.

#include "study/Exposure.h"

#include <pacini/synthesis/PanLaw.h>

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
    sorting,       ///< into as many heaps as there are kinds
    questionnaire, ///< a page of questions, without a stimulus
    place,         ///< where it was felt: a position on the row of actuators
    side,          ///< left or right of the middle of the row
    count,         ///< how many events were felt at once
    which          ///< which events were felt at once
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

/// Position of a touch on the row of actuators.
struct Place
{
    double position = 0.5; ///< 0: the first actuator (left), 1: the last
    PanLaw by = PanLaw::constantPower;
    bool operator==(const Place&) const = default;
};

/// Spectrum of a sound object.
enum class Mass
{
    definite, ///< one pitch
    complex,  ///< no definite pitch
    varying   ///< a pitch that changes
};

/// Envelope of a sound object.
enum class Facture
{
    continuous,
    impulse,
    iterative
};

/// Class of a sound in Schaeffer's typology (Traité des objets musicaux, 1966), such as X'' for complex and iterative.
struct SoundObject
{
    Mass mass = Mass::definite;
    Facture facture = Facture::continuous;
    bool operator==(const SoundObject&) const = default;
};

/// Returns Schaeffer's sign of a class: N, X or Y for the mass, with ' for an impulse and '' for an iterative sound.
[[nodiscard]] std::string signOf(const SoundObject& object);

/// A stimulus. At most one of clip, drive, tone, silence and mix defines the haptic part; without any it is the
/// translation of the sound.
struct Stimulus
{
    std::string name;  ///< never shown to participants
    std::string sound; ///< file, from the study's folder; empty: nothing to hear
    std::string clip;  ///< clip or scene file
    std::string drive; ///< sound file that drives the actuator as it is
    std::optional<Tone> tone;
    std::optional<double> silence;                  ///< s without touch
    std::vector<std::string> mix;                   ///< stimuli that are felt (and heard) at once
    std::string method;                             ///< of translation; empty: a2vt
    std::optional<double> bands, breakpoints, bits; ///< of translation by a2vt
    double soundLevel = 0.0;                        ///< dB
    double touchLevel = 0.0;                        ///< dB
    /// If one of these is given, it sets the peak of the touch, and touchLevel (not the study's) is relative to it.
    std::optional<double> sensationLevel; ///< dB above the weakest drive that is felt, by the actuator's profile
    std::optional<double> acceleration;   ///< m/s2 that are felt, by the actuator's profile
    std::optional<Place> place;           ///< none: all actuators alike
    std::optional<SoundObject> object;    ///< its class
    std::vector<std::string> tags;        ///< other classes, for the report
    Text label;                           ///< by which participants name it in the task `which`
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

/// Kind of a question in a questionnaire.
enum class QuestionKind
{
    text,   ///< free text
    number, ///< within the scale's ends, in its steps
    choice, ///< one of the choices
    likert  ///< agreement on the scale
};

/// An answer to choose.
struct ItemChoice
{
    std::string name; ///< in the results
    Text text;        ///< for participants; none: the name
    bool operator==(const ItemChoice&) const = default;
};

/// A question of a questionnaire.
struct Item
{
    std::string name; ///< in the results
    QuestionKind kind = QuestionKind::text;
    Text question;
    std::vector<ItemChoice> choices; ///< of kind choice
    RatingScale scale;               ///< of kinds number and likert
    bool optional = false;           ///< may stay empty
    bool operator==(const Item&) const = default;
};

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
    int intervals = 2;       ///< of forced choices: 2 or 3
    int repeats = 1;         ///< how often each stimulus comes
    int replays = -1;        ///< how often one may be played again; -1: any number
    double delay = 0.0;      ///< s of touch after sound, negative: before
    double pause = 0.5;      ///< pause between consecutive presentations, s
    bool masking = false;    ///< noise on the headphones while something is felt alone
    int breakAfter = 0;      ///< trials; 0: none
    bool feedback = false;   ///< whether an answer was right
    std::vector<Item> items; ///< of questionnaire
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
    double minutes = 60;                           ///< of a session
    /// dB(A), equivalent level of a stimulus; only with a calibration. None: 85.
    std::optional<double> soundLevel;
    /// dB(A), L_EX,8h of a session, at most 87 (limit value of the directive 2003/10/EC); only with a calibration.
    /// None: 80, its lower action value.
    std::optional<double> soundDaily;
    std::optional<double> loudness; ///< LUFS of a stimulus, integrated; none: any
    bool operator==(const ExposureLimits&) const = default;
};

inline constexpr double usualSoundLevel = 85.0, usualSoundDaily = 80.0; // dB(A)

/// Level of the calibration tone in the signal and at the ear, which gives the level of everything that is heard.
struct SoundCalibration
{
    double tone = -20.0; ///< dB re full scale (RMS)
    double level = 70.0; ///< dB SPL that was measured
    bool operator==(const SoundCalibration&) const = default;
};

/// Actuators in a row, on consecutive outputs.
struct TouchRow
{
    int actuators = 1;   ///< 1 to mostActuators
    double delay = 0.01; ///< s of an actuator at the other end, for places by delay
    bool operator==(const TouchRow&) const = default;
};
inline constexpr int mostActuators = 8;

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
    TouchRow row;
    std::optional<SoundCalibration> calibration;
    bool operator==(const Study&) const = default;
};

/// Plays the study on an actuator: `name` is its profile as the study names it. Exposure is then that of the part that
/// it shakes, limited to the action value.
void setActuator(Study& study, std::string name, const Profile& profile);

namespace studyLimits
{
inline constexpr std::size_t stimuli = 10'000, groups = 100, blocks = 100, items = 200, choices = 100, events = 12;
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

/// The classes that a stimulus belongs to, each with its place in reports: the sign of its sound object (X''), mass,
/// facture and tags.
[[nodiscard]] std::vector<std::pair<int, std::string>> classesOf(const Stimulus& stimulus);

/// Whether a stimulus belongs to the class of that name.
[[nodiscard]] bool belongsTo(const Stimulus& stimulus, std::string_view name);

/// Whether a task compares with a reference.
[[nodiscard]] bool needsReference(const Block& block);

/// Whether a block presents something.
[[nodiscard]] bool hasStimuli(const Block& block) noexcept;

/// Number of events that a stimulus consists of: none of silence, of a mix its parts.
[[nodiscard]] int eventsIn(const Stimulus& stimulus) noexcept;

/// The single events of a block's stimuli, as indices into the study's, in its order: the parts of mixes, and stimuli
/// that are neither mixes nor silence.
[[nodiscard]] std::vector<std::size_t> eventsOf(const Study& study, const Block& block);

/// The answers that a block of the task `count` offers: from 0 (if some stimulus is silence) or 1 to the number of
/// events.
[[nodiscard]] std::vector<int> countsOf(const Study& study, const Block& block);

/// The right answer to a single stimulus, as Answer::choice: of `side` 0 (left) or 1, of `count` the number of events,
/// of `which` the sum of 2^i over the events i of eventsOf(). -1 for none, as of a touch in the middle.
[[nodiscard]] int rightAnswer(const Study& study, const Block& block, std::size_t stimulus);

/// Chance of a right answer by guessing; 0 for tasks without one.
[[nodiscard]] double guessOf(const Study& study, const Block& block);

/// What is wrong with an answer to a question; none for a valid one. An empty text is no answer.
[[nodiscard]] std::optional<std::string> problemOf(const Item& item, const std::string& answer);

} // namespace pacini::study
