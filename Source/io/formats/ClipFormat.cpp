#include "io/formats/ClipFormat.h"

#include "io/formats/ahap/AhapFormat.h"
#include "io/formats/ahap/AhapSlips.h"
#include "io/formats/android/AndroidFormat.h"
#include "io/formats/android/VibrationXml.h"
#include "io/formats/csv/CsvFormat.h"
#include "io/formats/haps/HapsFormat.h"
#include "io/formats/haptic/HapticFormat.h"
#include "io/formats/hasp/HaspFormat.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hmpg/HmpgFormat.h"
#include "io/formats/json/JsonFormat.h"
#include "io/formats/openxr/OpenXrFormat.h"
#include "io/formats/packed/PackedFormat.h"
#include "io/formats/pulsar/PulsarFormat.h"
#include "io/formats/samples/PcmFormat.h"
#include "io/formats/tact/TactFormat.h"
#include "io/formats/vij/VijFormat.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pacini
{

namespace
{
/// Readers of other programs' formats are as strict as they are.
template <Result<ImportedClip> (*read)(std::string_view)>
Result<ImportedClip> always(std::string_view bytes, bool)
{
    return read(bytes);
}

/// All that `stream` writes as one file.
template <void (*stream)(Clip, const ClipFormat::PieceSink&)>
Result<ExportedClip> inOnePiece(const Clip& clip, const ExportParams&)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    ExportedClip result;
    std::string& bytes = result.files.emplace_back().bytes;
    stream(clip, [&bytes](std::string_view piece) { bytes += piece; });
    return result;
}

/// Sounds are read by the encoder.
constexpr bool isNoClip(std::string_view)
{
    return false;
}

template <Result<ExportedClip> (*write)(const Clip&, const ExportParams&, int), int bits>
Result<ExportedClip> samplesOf(const Clip& clip, const ExportParams& params)
{
    return write(clip, params, bits);
}

constexpr ClipFormat samples(std::string_view name, std::string_view title, std::string_view extension,
                             bool (*recognises)(std::string_view),
                             Result<ExportedClip> (*writer)(const Clip&, const ExportParams&))
{
    return {.name = name,
            .title = title,
            .extension = extension,
            .keeps = "Drive signal samples for the chosen actuator. Cannot be edited further.",
            .recognises = recognises,
            .writer = writer,
            .choices = {.profile = true, .drive = true},
            .isSamples = true};
}

#ifdef PACINI_READERS_ONLY
constexpr auto ahapReader = readAhap;
#else
constexpr auto ahapReader = readAhapWithSlips;
#endif

#ifdef PACINI_HAS_EXPAT
constexpr auto vibrationXmlReader = always<readVibrationXml>;
#else
constexpr Result<ImportedClip> (*vibrationXmlReader)(std::string_view, bool) = nullptr;
#endif

/// Formats of one voice with a frequency, in the range of an actuator.
constexpr ExportChoices voiceChoices{.amplitudePoints = true, .frequencyPoints = true, .profile = true};

/// The same as an envelope of control points.
constexpr ExportChoices envelopeChoices{
    .amplitudePoints = true, .frequencyPoints = true, .profile = true, .envelope = true};

constexpr ExportChoices driveAndEnvelope{.amplitudePoints = true, .profile = true, .drive = true};

/// Name, title, extension, what is kept, recognition, reader and writer come first.
constexpr std::array allFormats{
    ClipFormat{.name = "json",
               .title = "Pacini clip (JSON)",
               .extension = ".json",
               .keeps = "Keeps everything: curves, events, noise, markers, source.",
               .recognises = isClipJson,
               .reader = readClipJsonFile,
               .writer = inOnePiece<streamClipJson>,
               .stream = streamClipJson},
    ClipFormat{.name = "packed",
               .title = "Pacini clip (packed)",
               .extension = ".pacb",
               .keeps = "Keeps everything, rounded to the clip's quantiser, in a small file.",
               .recognises = isPackedClip,
               .reader = always<readPackedClip>,
               .writer = inOnePiece<streamPackedClip>,
               .stream = streamPackedClip},
    ClipFormat{.name = "haptic",
               .title = "Lofelt and Meta Haptics Studio, version 1",
               .extension = ".haptic",
               .keeps = "One voice: amplitude curve, frequency curve, and events as emphasis.",
               .recognises = isHaptic,
               .reader = always<readHaptic>,
               .writer = writeHaptic,
               .choices = voiceChoices,
               .events = usualEvents},
    ClipFormat{"vij", "Lofelt Studio Desktop, version 0.2", ".vij",
               "One voice: amplitude curve, frequency curve and events.", isVij, always<readVij>},
    ClipFormat{"hasp", "Meta Haptics Studio, projects of one clip", ".hasp",
               "One voice: amplitude curve, frequency curve, and events as emphasis.", isHasp, always<readHasp>},
    ClipFormat{.name = "ahap",
               .title = "Apple Core Haptics, AHAP",
               .extension = ".ahap",
               .keeps = "One voice: intensity curve, sharpness curve and events.",
               .recognises = isAhap,
               .reader = always<ahapReader>,
               .writer = writeAhap,
               .companion = ahapTransients,
               .choices = {.amplitudePoints = true, .frequencyPoints = true, .profile = true, .split = true},
               .events = usualEvents},
    ClipFormat{.name = "hjif",
               .title = "MPEG haptics interchange (ISO/IEC 23090-31)",
               .extension = ".hjif",
               .keeps = "Bands with amplitudes and frequencies, and events.",
               .recognises = isHjif,
               .reader = always<readHjif>,
               .writer = writeHjif,
               .choices = {.amplitudePoints = true, .frequencyPoints = true, .quick = true},
               .events = hjifEvents},
    ClipFormat{.name = "hmpg",
               .title = "MPEG haptics stream, binary (ISO/IEC 23090-31)",
               .extension = ".hmpg",
               .keeps = "Bands with amplitudes in 255 steps and frequencies, and events.",
               .recognises = isHmpg,
               .reader = always<readHmpg>,
               .writer = writeHmpg,
               .choices = {.amplitudePoints = true, .frequencyPoints = true, .quick = true},
               .events = hjifEvents},
    ClipFormat{.name = "haps",
               .title = "Interhaptics, version 5",
               .extension = ".haps",
               .keeps = "One voice: amplitude curve, frequency curve and events without sharpness.",
               .recognises = isHaps,
               .reader = always<readHaps>,
               .writer = writeHaps,
               .choices = voiceChoices},
#ifdef PACINI_HAS_LIBZIP
    ClipFormat{.name = "pulsar",
               .title = "Pulsar bundle of one preset, version 1",
               .extension = ".pulsar",
               .keeps = "One voice: amplitude curve, frequency curve and events.",
               .recognises = isPulsar,
               .reader = always<readPulsar>,
               .writer = writePulsar,
               .choices = voiceChoices,
               .events = usualEvents},
#endif
    ClipFormat{.name = "android",
               .title = "Android vibration effects, JSON",
               .extension = ".json",
               .keeps = "One voice as envelopes, and its strength in steps for devices without envelopes.",
               .recognises = isAndroidJson,
               .reader = always<readAndroidJson>,
               .writer = writeAndroidJson,
               .choices = envelopeChoices},
    ClipFormat{.name = "android-xml",
               .title = "Android vibration XML",
               .extension = ".xml",
               .keeps = "The strength of one voice in steps.",
               .recognises = isAndroidXml,
               .reader = vibrationXmlReader,
               .writer = writeAndroidXml,
               .choices = {.amplitudePoints = true, .split = true}},
    ClipFormat{.name = "android-envelope",
               .title = "Android vibration XML, waveform envelope (amplitude and Hz)",
               .extension = ".xml",
               .keeps = "One voice as an envelope of amplitude and frequency.",
               .recognises = isAndroidEnvelopeXml,
               .reader = vibrationXmlReader,
               .writer = writeAndroidEnvelopeXml,
               .choices = envelopeChoices},
    ClipFormat{.name = "android-basic",
               .title = "Android vibration XML, basic envelope (intensity and sharpness)",
               .extension = ".xml",
               .keeps = "One voice as an envelope of intensity and sharpness.",
               .recognises = isAndroidBasicXml,
               .reader = vibrationXmlReader,
               .writer = writeAndroidBasicXml,
               .choices = envelopeChoices},
    ClipFormat{.name = "android-kotlin",
               .title = "Android vibration effect, Kotlin",
               .extension = ".kt",
               .keeps = "One voice as an envelope, and its strength in steps for devices without envelopes.",
               .recognises = isAndroidKotlin,
               .writer = writeAndroidKotlin,
               .choices = envelopeChoices},
    ClipFormat{.name = "android-java",
               .title = "Android vibration effect, Java",
               .extension = ".java",
               .keeps = "One voice as an envelope, and its strength in steps for devices without envelopes.",
               .recognises = isAndroidJava,
               .writer = writeAndroidJava,
               .choices = envelopeChoices},
    ClipFormat{.name = "openxr",
               .title = "OpenXR PCM and amplitude envelope, C header",
               .extension = ".h",
               .keeps = "Samples of the drive signal, and its strength as an envelope.",
               .recognises = isOpenXrHeader,
               .writer = writeOpenXrHeader,
               .choices = driveAndEnvelope},
    ClipFormat{.name = "openxr-json",
               .title = "OpenXR PCM and amplitude envelope, JSON",
               .extension = ".json",
               .keeps = "Samples of the drive signal, and its strength as an envelope.",
               .recognises = isOpenXrJson,
               .writer = writeOpenXrJson,
               .choices = driveAndEnvelope},
    ClipFormat{"tact", "bHaptics, strength only", ".tact", "The strength of one voice in frames of 20 ms.", isTact,
               always<readTact>, writeTact},
    ClipFormat{"csv", "Table of all curves, comma-separated", ".csv",
               "All curves, events and noise; no names, markers or encoder parameters.", isCsv, always<readCsv>,
               writeCsv},
    samples("wav8", "Drive signal, WAV, 8 bit", ".wav", isNoClip, samplesOf<writeWav, 8>),
    samples("wav16", "Drive signal, WAV, 16 bit", ".wav", isNoClip, samplesOf<writeWav, 16>),
    samples("raw8", "Drive signal, signed 8-bit samples", ".s8", nullptr, samplesOf<writeRaw, 8>),
    samples("raw16", "Drive signal, signed 16-bit samples", ".s16", nullptr, samplesOf<writeRaw, 16>),
    samples("c", "Drive signal, C array for firmware", ".h", isCArray, writeCArray),
};
/// Computed by the compiler, so that a program that has only these does not have the formats.
constexpr auto descriptions = []
{
    std::array<FormatDescription, allFormats.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const ClipFormat& one = allFormats[i];
        all[i] = {one.name, one.title, one.extension, one.keeps, one.isRead(), one.isWritten(), one.isSamples};
    }
    return all;
}();

#ifdef PACINI_READERS_ONLY
/// Its parameters are those of ClipFormat::stream.
void noStream(Clip, const ClipFormat::PieceSink&) // NOLINT(performance-unnecessary-value-param)
{
}

/// What only plays clips takes no writers along.
constexpr auto formats = []
{
    auto readers = allFormats;
    for (ClipFormat& format : readers)
    {
        format.writer = nullptr;
        if (format.stream != nullptr)
            format.stream = noStream;
    }
    return readers;
}();
#elif defined(PACINI_OWN_FORMATS_ONLY)
constexpr std::array formats{allFormats[0], allFormats[1]};
#else
constexpr const auto& formats = allFormats;
#endif
} // namespace

std::span<const ClipFormat> clipFormats()
{
    return formats;
}

std::span<const FormatDescription> formatDescriptions()
{
    return descriptions;
}

const ClipFormat* clipFormatNamed(std::string_view name)
{
    const auto found =
        std::find_if(formats.begin(), formats.end(), [&](const ClipFormat& format) { return format.name == name; });
    return found == formats.end() ? nullptr : &*found;
}

const ClipFormat& jsonFormat()
{
    return formats[0];
}

const ClipFormat& packedFormat()
{
    return formats[1];
}

const ClipFormat* clipFormatWrittenTo(std::string_view extension)
{
    const auto found =
        std::find_if(formats.begin(), formats.end(),
                     [&](const ClipFormat& format) { return format.isWritten() && format.extension == extension; });
    return found == formats.end() ? nullptr : &*found;
}

bool isOwnExtension(std::string_view extension)
{
    const ClipFormat* format = clipFormatWrittenTo(extension);
    return format != nullptr && format->isOwn();
}

bool isForeignExtension(std::string_view extension)
{
    return std::any_of(formats.begin(), formats.end(),
                       [&](const ClipFormat& format)
                       { return format.isRead() && !format.isOwn() && format.extension == extension; });
}

const ClipFormat* clipFormatOf(std::string_view extension, std::string_view bytes)
{
    const ClipFormat* found = nullptr;
    const ClipFormat* byName = nullptr;
    for (const ClipFormat& format : formats)
    {
        const bool named = format.extension == extension;
        const bool recognised = format.recognises != nullptr && format.recognises(bytes);
        if (recognised && (named || format.isOwn()))
            return &format;
        if (recognised && found == nullptr)
            found = &format;
        if (named && byName == nullptr && !format.isOwn() && (format.isRead() || format.recognises == nullptr))
            byName = &format;
    }
    return found == nullptr && extension != ".json" ? byName : found;
}

std::string_view lossName(LossKind kind)
{
    constexpr std::array<std::string_view, 12> names{"bands",    "points",    "length",   "frequency",
                                                     "timeStep", "amplitude", "crowding", "event",
                                                     "noise",    "empty",     "text",     "transient"};
    return names[static_cast<std::size_t>(kind)];
}

} // namespace pacini
