// Sounds to clips, or to drive signals by methods that make no clip.

#include "io/EncoderPresets.h"
#include "io/Settings.h"
#include "io/SoundEncoder.h"
#include "python/native/ClipHandle.h"
#include "python/native/Options.h"
#include "python/native/Support.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::python
{

namespace
{
/// How sounds are encoded: options by their names in Python before those of `settings`, the text of a document.
struct EncodeOptions
{
    std::string method; ///< empty: that of `settings`, else a2vt
    std::string preset; ///< empty: none
    nb::dict options;
    std::string settings; ///< empty: none
    bool allowNan = false;
    bool allowTruncated = false;
};

[[noreturn]] void wrong(std::string where, std::string message)
{
    raise({ErrorCode::invalidArgument, std::move(where), std::move(message)});
}

SoundEncoderParams paramsOf(const EncodeOptions& options, ReadWarnings& warnings)
{
    Settings settings;
    if (!options.settings.empty())
        settings = take(readSettings(options.settings, &warnings));
    if (!options.method.empty())
        settings.method = options.method;
    if (!options.preset.empty())
        takeNamed(usePreset(settings, options.preset));
    for (const auto& [parameter, value] : givenOptions(options.options, translationParameters()))
        settings.encode.set(*parameter, value);
    SoundEncoderParams params;
    static_cast<TranslationParams&>(params) = takeNamed(translationOf(settings));
    params.reading.allowTruncated = options.allowTruncated;
    params.reading.allowNan = options.allowNan;
    return params;
}

/// A clip as files have it, or a drive signal at its rate.
using Encoded = std::variant<Clip, std::vector<float>>;

/// Encodes sounds with one set of options, by one thread at a time; keeps transforms between them.
class EncoderHandle
{
public:
    explicit EncoderHandle(const EncodeOptions& options)
        : params(paramsOf(options, warnings)), encoder(std::make_shared<SoundEncoder>(params))
    {
    }

    [[nodiscard]] nb::object encodeArray(const SoundArray& array, int rate, std::string name, std::string source,
                                         nb::object progress)
    {
        const SoundView sound = soundOf(array);
        if (rate < limits::lowestSampleRate || rate > limits::highestSampleRate)
            wrong("sample_rate", "must be 8000 to 768000 Hz");
        if (static_cast<double>(sound.frames) / rate > limits::duration)
            raise({ErrorCode::tooLarge, "sound", "is longer than 24 hours; cut it into parts"});
        Watch watch(std::move(progress));
        const Unsound unsound = params.reading.allowNan ? Unsound::silence : Unsound::refuse;
        const SoundFormat format{rate, static_cast<int>(sound.channels), sound.frames, std::nullopt};
        if (params.method == Method::a2vt)
        {
            auto clip = unlocked(
                [&]
                {
                    ArrayParts parts(sound, unsound, watch);
                    Stopwatch work;
                    return encoder->clipOf(format, parts, {std::move(name), std::move(source)}, work);
                });
            return nb::cast(ClipHandle(take(std::move(clip))));
        }
        // The other methods hold all of a sound, and cannot be stopped in their midst.
        auto samples = take(unlocked(
            [&]() -> Result<std::vector<float>>
            {
                ArrayParts parts(sound, unsound, watch);
                std::vector<float> all;
                all.reserve(sound.frames * sound.channels);
                for (;;)
                {
                    const SoundPart part = parts();
                    if (!part)
                        return part.error();
                    if (part->empty())
                        return all;
                    all.insert(all.end(), part->begin(), part->end());
                }
            }));
        return handedOut(take(abandonable(
            [shared = encoder, method = params.method, format, samples = std::move(samples), name = std::move(name),
             source = std::move(source)]() mutable
            {
                SoundParts parts(samples, format.channels);
                Stopwatch work;
                return encoded(
                    method,
                    [&] {
                        return shared->clipOf(format, parts, {std::move(name), std::move(source)}, work);
                    },
                    [&] { return shared->signalOf(format, parts, work); });
            })));
    }

    /// A clip, or a signal with its rate.
    [[nodiscard]] nb::object encodeFile(const std::filesystem::path& path, nb::object progress)
    {
        Watch watch(std::move(progress));
        const auto read = [&](const std::function<void(double)>& toTell)
        {
            return fromFile(*encoder, params, path, toTell);
        };
        int rate = 0;
        if (params.method == Method::a2vt)
            return handedOut(ofSound(takeIn(path, unlocked([&] { return read(std::ref(watch)); }))));
        auto made = takeIn(path, abandonable([shared = encoder, settings = params, path]
                                             { return fromFile(*shared, settings, path, [](double) {}); }));
        rate = made.rate;
        nb::object result = handedOut(ofSound(std::move(made)));
        return methodInfo(params.method).output == MethodOutput::clip ? result : nb::make_tuple(result, rate);
    }

    /// What was let pass in the settings.
    [[nodiscard]] std::vector<std::string> doubts() const { return warnings.texts(); }

    /// What was let pass in the file that was encoded last.
    [[nodiscard]] std::vector<std::string> soundDoubts() const { return ofLastSound; }

    [[nodiscard]] bool makesClip() const { return methodInfo(params.method).output == MethodOutput::clip; }

private:
    template <typename MakeClip, typename MakeSignal>
    [[nodiscard]] static Result<Encoded> encoded(Method method, MakeClip&& makeClip, MakeSignal&& makeSignal)
    {
        if (methodInfo(method).output == MethodOutput::clip)
        {
            auto clip = makeClip();
            return clip ? Result<Encoded>(std::move(*clip)) : clip.error();
        }
        auto signal = makeSignal();
        return signal ? Result<Encoded>(std::move(*signal)) : signal.error();
    }

    struct EncodedFile
    {
        Encoded made;
        int rate = 0;
        std::vector<std::string> warnings;
    };

    [[nodiscard]] Encoded ofSound(EncodedFile file)
    {
        ofLastSound = std::move(file.warnings);
        return std::move(file.made);
    }

    [[nodiscard]] static Result<EncodedFile> fromFile(SoundEncoder& encoder, const SoundEncoderParams& params,
                                                      const std::filesystem::path& path,
                                                      const std::function<void(double)>& progress)
    {
        auto reader = AudioReader::open(path, params.reading);
        if (!reader)
            return reader.error();
        Stopwatch work;
        auto made = encoded(
            params.method, [&] { return encoder.clipOf(*reader, path, progress, work); },
            [&]
            {
                SoundFileParts parts(*reader, progress);
                return encoder.signalOf({reader->sampleRate(), reader->channels()}, parts, work);
            });
        if (!made)
            return made.error();
        return EncodedFile{std::move(*made), reader->sampleRate(), reader->warnings()};
    }

    [[nodiscard]] static nb::object handedOut(Encoded made)
    {
        if (auto* clip = std::get_if<Clip>(&made))
            return nb::cast(ClipHandle(std::move(*clip)));
        return toArray(std::get<std::vector<float>>(std::move(made)));
    }

    ReadWarnings warnings;
    std::vector<std::string> ofLastSound;
    SoundEncoderParams params;
    std::shared_ptr<SoundEncoder> encoder;
};

std::vector<std::tuple<std::string, std::string, std::string>> methodList()
{
    std::vector<std::tuple<std::string, std::string, std::string>> list;
    for (const MethodInfo& info : methodTable)
        list.emplace_back(info.name, info.output == MethodOutput::clip ? "clip" : "signal", info.description);
    return list;
}

std::vector<std::tuple<std::string, std::string>> presetList()
{
    std::vector<std::tuple<std::string, std::string>> list;
    for (const EncoderPreset& preset : encoderPresets())
        list.emplace_back(optionName(preset), preset.purpose);
    return list;
}
} // namespace

void bindEncode(nb::module_& module)
{
    nb::class_<EncoderHandle>(module, "EncoderHandle")
        .def(
            "__init__",
            [](EncoderHandle* self, std::string method, std::string preset, nb::dict options, std::string settings,
               bool allowNan, bool allowTruncated)
            {
                new (self) EncoderHandle(EncodeOptions{std::move(method), std::move(preset), std::move(options),
                                                       std::move(settings), allowNan, allowTruncated});
            },
            "method"_a, "preset"_a, "options"_a, "settings"_a, "allow_nan"_a, "allow_truncated"_a)
        .def("encode_array", &EncoderHandle::encodeArray, "sound"_a, "sample_rate"_a, "name"_a, "source"_a,
             "progress"_a.none())
        .def("encode_file", &EncoderHandle::encodeFile, "path"_a, "progress"_a.none())
        .def_prop_ro("doubts", &EncoderHandle::doubts)
        .def_prop_ro("sound_doubts", &EncoderHandle::soundDoubts)
        .def_prop_ro("makes_clip", &EncoderHandle::makesClip);
    module.def("methods", &methodList);
    module.def("presets", &presetList);
    module.def("encode_parameters", [] { return translationDescriptionsJson().dump(); });
}

} // namespace pacini::python
