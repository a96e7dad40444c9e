#include "python/native/Support.h"

#include "io/AudioReader.h"
#include "io/ErrorCodeName.h"

#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/SnakeCase.h>

#include <nanobind/stl/string.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#ifndef _WIN32
#include <unistd.h>
#endif

namespace pacini::python
{

namespace
{
std::atomic<int> abandoned{0};

/// The process that the threads are of: a child that was forked off has none of them.
#ifdef _WIN32
long processId()
{
    return 0;
}
#else
long processId()
{
    return static_cast<long>(getpid());
}
#endif
std::atomic<long> owner{0};

std::string placeOf(std::size_t channels, std::size_t channel, std::size_t frame)
{
    return channels == 1 ? "sound[" + std::to_string(frame) + "]"
                         : "sound[" + std::to_string(channel) + ", " + std::to_string(frame) + "]";
}
} // namespace

namespace
{
[[noreturn]] void raiseAt(const std::string& where, const Error& error)
{
    // Names of files need not be UTF-8: as Python has them.
    const auto text = [](const std::string& bytes)
    {
        return nb::steal<nb::str>(
            PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape"));
    };
    const nb::object type = nb::module_::import_("pacini._errors").attr("Error");
    const nb::object value = type(text(error.message), text(where), std::string(errorCodeName(error.code)));
    PyErr_SetObject(value.type().ptr(), value.ptr());
    throw nb::python_error();
}
} // namespace

void raise(const Error& error)
{
    // An argument is called as in Python; what is in a file, as the file has it.
    raiseAt(error.code == ErrorCode::invalidArgument ? snakeCase(error.where) : error.where, error);
}

void raiseIn(const std::filesystem::path& path, const Error& error)
{
    raiseAt(path.string() + (error.where.empty() ? "" : ": ") + error.where, error);
}

void Watch::operator()(double share)
{
    const auto now = std::chrono::steady_clock::now();
    if (now - last < std::chrono::milliseconds(100))
        return;
    last = now;
    const nb::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0)
        throw nb::python_error();
    if (!shown.is_none())
        shown(share);
}

bool isMainThread()
{
    const nb::module_ threading = nb::module_::import_("threading");
    return nb::cast<unsigned long>(threading.attr("main_thread")().attr("ident")) ==
           nb::cast<unsigned long>(threading.attr("get_ident")());
}

void AbandonedWork::begin() noexcept
{
    if (owner.exchange(processId()) != processId())
        abandoned = 0;
    ++abandoned;
}

void AbandonedWork::end() noexcept
{
    --abandoned;
}

void AbandonedWork::wait()
{
    while (owner == processId() && abandoned > 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

SoundView soundOf(const SoundArray& array)
{
    const auto wrong = [](std::string message)
    {
        raise({ErrorCode::invalidArgument, "sound", std::move(message)});
    };
    if (array.ndim() != 1 && array.ndim() != 2)
        wrong("has " + std::to_string(array.ndim()) + " dimensions; give (frames,) or (channels, frames)");
    SoundView view;
    view.isDouble = array.dtype() == nb::dtype<double>();
    if (!view.isDouble && array.dtype() != nb::dtype<float>())
        wrong("must be of float32 or float64, full scale 1");
    view.data = array.data();
    const std::size_t last = array.ndim() - 1;
    view.frames = array.shape(last);
    view.frameStride = array.stride(last);
    if (last == 1)
    {
        view.channels = array.shape(0);
        view.channelStride = array.stride(0);
    }
    if (view.channels < 1 || view.channels > static_cast<std::size_t>(limits::channels))
        wrong("has " + std::to_string(view.channels) +
              " channels, 1 to 64 can be; give (frames,) or (channels, frames), or say which axis the frames are on");
    if (view.channels == 1 && view.frames <= 1)
        view.frameStride = 1; // of no meaning then
    return view;
}

SoundPart ArrayParts::operator()()
{
    if (sound.frames > 0)
        watch(static_cast<double>(position) / static_cast<double>(sound.frames));
    const std::size_t channels = sound.channels;
    const std::size_t frames = std::min(soundPartLength(channels) / channels, sound.frames - position);
    const std::size_t count = frames * channels;
    if (sound.isInterleaved())
    {
        const std::span part(static_cast<const float*>(sound.data) + position * channels, count);
        if (unsound == Unsound::keep || areWithinLimit(part))
        {
            position += frames;
            return part;
        }
    }
    buffer.resize(count);
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < frames; ++i)
            buffer[i * channels + c] = sound.at(c, position + i);
    if (unsound != Unsound::keep && !areWithinLimit(buffer))
        if (auto error = repair(buffer))
            return *error;
    position += frames;
    return std::span<const float>(buffer);
}

std::optional<Error> ArrayParts::repair(std::span<float> part)
{
    for (std::size_t i = 0; i < part.size(); ++i)
    {
        float& sample = part[i];
        if (areWithinLimit(std::span(&sample, 1)))
            continue;
        if (unsound == Unsound::refuse)
            return Error{
                ErrorCode::notFinite, placeOf(sound.channels, i % sound.channels, position + i / sound.channels),
                std::isnan(sample)   ? "is NaN; repair the sound, or take such samples as 0 with allow_nan"
                : std::isinf(sample) ? "is infinite; repair the sound, or take such samples as 0 with allow_nan"
                                     : "is far beyond full scale; repair the sound, or take such samples as "
                                       "0 with allow_nan"};
        sample = 0.0f;
        ++replaced;
    }
    return std::nullopt;
}

std::vector<float> monoOf(const SoundView& sound)
{
    std::vector<float> mono(sound.frames);
    for (std::size_t i = 0; i < sound.frames; ++i)
    {
        if (sound.channels == 1)
        {
            mono[i] = sound.at(0, i);
            continue;
        }
        double sum = 0.0;
        for (std::size_t c = 0; c < sound.channels; ++c)
            sum += static_cast<double>(sound.at(c, i));
        mono[i] = static_cast<float>(sum / static_cast<double>(sound.channels));
    }
    return mono;
}

} // namespace pacini::python
