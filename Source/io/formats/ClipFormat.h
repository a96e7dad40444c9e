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
    frequency, ///< a frequency is outside the format's range
    timeStep,  ///< times were moved to the format's grid
    amplitude, ///< an amplitude is outside the format's range
    crowding,  ///< events are closer than the format allows
    event,     ///< the format cannot represent an event or a property of it
    noise,     ///< the format cannot represent residual noise
    empty,     ///< the result is silent here
    text,      ///< the format cannot represent names, markers or sources
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
    std::string message;   ///< the change, in words
    bool operator==(const FormatLoss&) const = default;
};

struct ImportedClip
{
    Clip clip;
    std::vector<std::string> warnings; ///< tolerated problems, with the place first
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

/// The default of formats with this choice; HJIF has its own (hjifEvents).
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
    std::optional<Profile> profile;         ///< for formats that do not define their frequencies, and for rendering
    std::optional<int> sampleRate;          ///< Hz, of formats that are samples
    bool split = false;                     ///< write several files, in formats that allow one or several
    bool quick = false;                     ///< skip the search for the best file; the result is usually good
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
    std::string_view keeps;     ///< the preserved content of a clip, as a sentence

    /// Whether a file's content is of this format; null: only the extension tells.
    bool (*recognises)(std::string_view bytes) = nullptr;
    Result<ImportedClip> (*reader)(std::string_view bytes, bool strict) = nullptr;          ///< null: no import
    Result<ExportedClip> (*writer)(const Clip& clip, const ExportParams& params) = nullptr; ///< null: no export
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

    /// Returns the files of a clip, and the losses; those of quantising a packed clip are not counted. Errors: those of
    /// validate() and of the format's writer.
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

/// Descriptions of all existing formats, in the order of clipFormats(), including those that it leaves out.
[[nodiscard]] std::span<const FormatDescription> formatDescriptions();

/// Returns the format of this name; null if there is none.
[[nodiscard]] const ClipFormat* clipFormatNamed(std::string_view name);

/// Pacini's own: JSON to read and edit, and packed, which is small.
[[nodiscard]] const ClipFormat& jsonFormat();
[[nodiscard]] const ClipFormat& packedFormat();

/// Returns the format written to files of this extension (with dot, lower case), the first if there are several; null
/// if there is none.
[[nodiscard]] const ClipFormat* clipFormatWrittenTo(std::string_view extension);

/// Whether this extension is one of Pacini's own.
[[nodiscard]] bool isOwnExtension(std::string_view extension);

/// Whether files of this extension (with dot, lower case) are clips of other programs, whatever their content.
[[nodiscard]] bool isForeignExtension(std::string_view extension);

/// Returns the format of a file with this extension (with dot, lower case) and content; null if there is none. A clip
/// that claims to be Pacini's is Pacini's. If several others recognise the content, the one with the extension counts.
/// If none does, the format with the extension counts, and its reader reports the error; an exception is .json, the
/// extension of any program, which is then no format. Formats that are only written are also recognised by their
/// content.
[[nodiscard]] const ClipFormat* clipFormatOf(std::string_view extension, std::string_view bytes);

/// A kind of loss in one word, such as `points`.
[[nodiscard]] std::string_view lossName(LossKind kind);

} // namespace pacini
