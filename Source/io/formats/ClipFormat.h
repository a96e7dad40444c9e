#pragma once

// Table of the clip file formats of Pacini and other programs, with their readers, writers and losses.

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Kinds of losses or changes that a format makes to a clip in one place.
enum class LossKind
{
    bands,     ///< bands became fewer
    points,    ///< breakpoints were left out
    length,    ///< the clip is longer or shorter than the format plays
    frequency, ///< a frequency lies outside of what the format can say
    timeStep,  ///< times were moved to the format's grid
    amplitude, ///< an amplitude lies outside of what the format can say
    crowding,  ///< events are nearer to each other than the format plays
    event,     ///< an event or a property of it cannot be said
    noise,     ///< residual noise cannot be said
    empty,     ///< nothing is left here
    text,      ///< names, markers or sources cannot be said
    transient  ///< an event is none of the format's transients; one loss for each
};

/// One loss. Losses of one kind that follow each other are one.
struct FormatLoss
{
    LossKind kind = LossKind::points;
    double time = 0.0;     ///< s from the start of the clip
    double duration = 0.0; ///< s; 0 for a moment or the whole clip
    double error = 0.0;    ///< largest error of the amplitude there (1 = full drive), of the frequency in octaves for
                           ///< `frequency`, of the time in s for `timeStep` and `length`; the event's amplitude for
                           ///< `transient`
    std::string message;   ///< what happens, for people
    bool operator==(const FormatLoss&) const = default;
};

struct ImportedClip
{
    Clip clip;
    std::vector<std::string> warnings; ///< what was let pass, with the place first
};

/// One file that a format needs; most need one.
struct ExportedFile
{
    std::string suffix; ///< goes between the name and the extension, such as `-transients`; empty for the main file
    std::string bytes;
};

struct ExportedClip
{
    std::vector<ExportedFile> files;
    std::vector<FormatLoss> losses; ///< by time
};

/// Ways to write the events of a clip with several bands, in formats with transients.
enum class EventExport
{
    transients, ///< every event is one, with the voice ducked around it: nothing is played twice
    merged      ///< events that the voice reaches by itself are left to it
};

/// What formats with such a choice do unless something else is asked for; HJIF has an own (hjifEvents).
inline constexpr EventExport usualEvents = EventExport::transients;

/// Limits of a device for envelopes of control points; the defaults suit every Android device.
struct EnvelopeLimits
{
    std::size_t points = 0;      ///< at most, 2 or more; 0: any number
    std::int64_t shortest = 1;   ///< ms from one to the next, 1 or more; not every device plays less than 20
    std::int64_t longest = 1000; ///< ms, twice as many or more; a straight line that is longer is several
    bool operator==(const EnvelopeLimits&) const = default;
};

struct ExportParams
{
    std::string name;                       ///< of the clip, for formats that carry one; empty: the clip's own
    std::optional<double> amplitudePoints;  ///< per second; none: what the format is used with
    std::optional<double> frequencyPoints;  ///< per second; likewise
    std::optional<Profile> profile;         ///< where a format leaves open what its frequencies mean, and for rendering
    std::optional<int> sampleRate;          ///< Hz, of formats that are samples
    bool split = false;                     ///< formats that can be one file or several: several
    bool quick = false;                     ///< formats whose best file is searched for: one that is mostly good
    std::optional<EventExport> events;      ///< none: as usual for the format, see ClipFormat::events
    std::optional<EnvelopeLimits> envelope; ///< none: as usual for the format
    double strength = standardStrength;     ///< of drive signals for `profile`, 0 to 1, see fitActuator
    bool operator==(const ExportParams&) const = default;
};

/// The fields of ExportParams with an effect in a format, beside `events`.
struct ExportChoices
{
    bool amplitudePoints = false;
    bool frequencyPoints = false;
    bool profile = false;
    bool drive = false; ///< sampleRate, and strength where there is a profile
    bool split = false;
    bool quick = false;
    bool envelope = false;
};

/// A format. Readers are lenient where the format's own players are and say so in warnings; writers keep every rule
/// after rounding. Bytes depend on clip and parameters only.
struct ClipFormat
{
    using PieceSink = std::function<void(std::string_view piece)>;

    std::string_view name;      ///< on the command line, such as `haptic`
    std::string_view title;     ///< for people
    std::string_view extension; ///< with dot, lower case
    std::string_view keeps;     ///< what it keeps of a clip, a sentence for people

    /// Whether a file's content is of this format; null: only the extension tells.
    bool (*recognises)(std::string_view bytes) = nullptr;
    Result<ImportedClip> (*reader)(std::string_view bytes, bool strict) = nullptr;          ///< null: is not read
    Result<ExportedClip> (*writer)(const Clip& clip, const ExportParams& params) = nullptr; ///< null: is not written
    std::string_view companion = {}; ///< suffix of a second file whose events belong to the clip, if there can be one
    ExportChoices choices = {};
    bool isSamples = false;                 ///< the drive signal, at a rate and for an actuator that can be chosen
    std::optional<EventExport> events = {}; ///< how events are written unless something else is asked for; none: the
                                            ///< format leaves no choice

    /// Writes a valid clip piece by piece, since a clip of hours is large; only Pacini's own formats, which keep all of
    /// a clip with its encoder's record.
    void (*stream)(Clip clip, const PieceSink& sink) = nullptr;

    [[nodiscard]] bool isOwn() const noexcept { return stream != nullptr; }
    [[nodiscard]] constexpr bool isRead() const noexcept { return reader != nullptr; }
    [[nodiscard]] constexpr bool isWritten() const noexcept { return writer != nullptr; }

    /// The clip in a file's content. Keys of Pacini's formats that are not known are warnings, or errors if it is
    /// `strict`. Errors: those of the format's reader.
    [[nodiscard]] Result<ImportedClip> read(std::string_view bytes, bool strict = false) const
    {
        return reader(bytes, strict);
    }

    /// The files that a clip becomes, and what is lost; what quantising a packed clip costs is not counted. Errors:
    /// those of validate() and of the format's writer.
    [[nodiscard]] Result<ExportedClip> write(const Clip& clip, const ExportParams& params = {}) const
    {
        return writer(clip, params);
    }
};

/// All formats in the order in which they are listed, Pacini's own first.
[[nodiscard]] std::span<const ClipFormat> clipFormats();

/// Description of a format, without its reader and writer.
struct FormatDescription
{
    std::string_view name, title, extension, keeps; ///< as in ClipFormat
    bool isRead = false;
    bool isWritten = false;
    bool isSamples = false;
};

/// Of all formats that there are, also where clipFormats() leaves some out, in the same order.
[[nodiscard]] std::span<const FormatDescription> formatDescriptions();

/// The format of this name; null when there is none.
[[nodiscard]] const ClipFormat* clipFormatNamed(std::string_view name);

/// Pacini's own: JSON to read and edit, and packed, which is small.
[[nodiscard]] const ClipFormat& jsonFormat();
[[nodiscard]] const ClipFormat& packedFormat();

/// The format that is written to files of this extension (with dot, lower case): the first; null when there is none.
[[nodiscard]] const ClipFormat* clipFormatWrittenTo(std::string_view extension);

/// Whether that is one of Pacini's own.
[[nodiscard]] bool isOwnExtension(std::string_view extension);

/// Whether files of this extension (with dot, lower case) are clips of other programs, whatever they hold.
[[nodiscard]] bool isForeignExtension(std::string_view extension);

/// The format of a file with this extension (with dot, lower case) and content; null when it is none. A clip that says
/// that it is Pacini's is that. Of several others that recognise the content the one with the extension counts. What
/// none recognises is of the format with the extension, whose reader then says what is wrong with it; but any program's
/// file can be called .json, which is then none. Formats that are only written are found too, by their content.
[[nodiscard]] const ClipFormat* clipFormatOf(std::string_view extension, std::string_view bytes);

/// A kind of loss in one word, such as `points`.
[[nodiscard]] std::string_view lossName(LossKind kind);

} // namespace pacini
