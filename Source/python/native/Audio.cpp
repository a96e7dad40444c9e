// Audio files: into arrays, and from them.

#include "io/AtomicFile.h"
#include "io/AudioReader.h"
#include "io/AudioWriter.h"
#include "python/native/Overwriting.h"
#include "python/native/Support.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <string>
#include <utility>

namespace pacini::python
{

namespace
{
/// (frames, channels) as the file has them, the rate, and what was let pass.
nb::object readFile(const std::filesystem::path& path, bool allowNan, bool allowTruncated, bool keepNan)
{
    AudioReadOptions options;
    options.allowNan = allowNan;
    options.allowTruncated = allowTruncated;
    options.keepNan = keepNan;
    options.lowestSampleRate = limits::lowestWrittenRate;
    auto audio = takeIn(path, abandonable([path, options] { return readAudio(path, options); }));
    const auto channels = static_cast<std::size_t>(audio.channels);
    const std::size_t frames = audio.samples.size() / channels;
    return nb::make_tuple(toArray(std::move(audio.samples), {frames, channels}), audio.sampleRate, audio.warnings);
}

/// The number of samples that were clipped.
std::uint64_t writeFile(const std::filesystem::path& path, const SoundArray& array, int rate,
                        const std::string& encoding, Overwrite overwrite)
{
    const SoundView sound = soundOf(array);
    AudioWriteParams params;
    params.sampleRate = rate;
    params.channels = static_cast<int>(sound.channels);
    params.expectedFrames = sound.frames;
    if (encoding == "pcm16")
        params.encoding = SampleEncoding::pcm16;
    else if (encoding == "pcm24")
        params.encoding = SampleEncoding::pcm24;
    else if (encoding != "float32")
        raise({ErrorCode::invalidArgument, "encoding", "must be float32, pcm24 or pcm16"});
    params.existing = mayWrite(path, FileKind::madeSound, overwrite);
    Watch watch{nb::none()};
    auto written = unlocked(
        [&]() -> Result<AudioWriteReport>
        {
            auto writer = AudioWriter::create(path, params);
            if (!writer)
                return writer.error();
            ArrayParts parts(sound, Unsound::keep, watch); // the writer refuses what is no number
            for (;;)
            {
                const SoundPart part = parts();
                if (!part)
                    return part.error();
                if (part->empty())
                    return writer->finish();
                if (auto done = writer->write(*part); !done)
                    return done.error();
            }
        });
    return takeIn(path, std::move(written)).clippedSamples;
}
} // namespace

void bindAudio(nb::module_& module)
{
    module.def("read_audio", &readFile, "path"_a, "allow_nan"_a, "allow_truncated"_a, "keep_nan"_a);
    module.def(
        "write_text",
        [](const std::filesystem::path& path, const std::string& text)
        { return take(unlocked([&] { return writeFileAtomically(path, text); })); },
        "path"_a, "text"_a);
    module.def("write_audio", &writeFile, "path"_a, "sound"_a, "sample_rate"_a, "encoding"_a, "overwrite"_a.none());
}

} // namespace pacini::python
