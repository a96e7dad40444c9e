#include "live/SoundPort.h"

#include "io/SoundLibraryCall.h"
#include "live/DevicePace.h"
#include "live/PulseServer.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#if defined(PACINI_HAS_RTAUDIO)
#include "live/OpenedLibrary.h"

#include <rtaudio_c.h>
#endif

namespace pacini::live
{

#if defined(PACINI_HAS_RTAUDIO)

namespace
{
std::string_view systemName(rtaudio_api_t api)
{
    switch (api)
    {
    case RTAUDIO_API_UNIX_JACK:
        return "jack";
    case RTAUDIO_API_LINUX_PULSE:
        return "pulse";
    case RTAUDIO_API_LINUX_ALSA:
        return "alsa";
    case RTAUDIO_API_MACOSX_CORE:
        return "core";
    default:
        return "";
    }
}

/// RtAudio's functions for C. It is opened when it is wanted: what it links, such as JACK's and PulseAudio's libraries,
/// would make the start of every command half as long again. Nothing is missing without it but sound devices.
struct RtAudioLibrary : OpenedLibrary
{
#if defined(__APPLE__)
    static constexpr const char* file = "librtaudio.6.dylib";
#else
    static constexpr const char* file = "librtaudio.so.6";
#endif

    RtAudioLibrary() : OpenedLibrary(file)
    {
        find(systemCount, "rtaudio_get_num_compiled_apis");
        find(systems, "rtaudio_compiled_api");
        find(error, "rtaudio_error");
        find(create, "rtaudio_create");
        find(destroy, "rtaudio_destroy");
        find(deviceCount, "rtaudio_device_count");
        find(deviceInfo, "rtaudio_get_device_info");
        find(openStream, "rtaudio_open_stream");
        find(closeStream, "rtaudio_close_stream");
        find(startStream, "rtaudio_start_stream");
        find(abortStream, "rtaudio_abort_stream");
        find(isOpen, "rtaudio_is_stream_open");
        find(isRunning, "rtaudio_is_stream_running");
        find(showWarnings, "rtaudio_show_warnings");
    }

    decltype(&rtaudio_get_num_compiled_apis) systemCount;
    decltype(&rtaudio_compiled_api) systems;
    decltype(&rtaudio_error) error;
    decltype(&rtaudio_create) create;
    decltype(&rtaudio_destroy) destroy;
    decltype(&rtaudio_device_count) deviceCount;
    decltype(&rtaudio_get_device_info) deviceInfo;
    decltype(&rtaudio_open_stream) openStream;
    decltype(&rtaudio_close_stream) closeStream;
    decltype(&rtaudio_start_stream) startStream;
    decltype(&rtaudio_abort_stream) abortStream;
    decltype(&rtaudio_is_stream_open) isOpen;
    decltype(&rtaudio_is_stream_running) isRunning;
    decltype(&rtaudio_show_warnings) showWarnings;
};

const RtAudioLibrary& library()
{
    return openedLibrary<RtAudioLibrary>();
}

std::vector<rtaudio_api_t> compiledSystems()
{
    std::vector<rtaudio_api_t> named;
    if (library().isThere)
        for (unsigned i = 0; i < library().systemCount(); ++i)
            if (const auto api = library().systems()[i]; !systemName(api).empty())
                named.push_back(api);
    return named;
}

/// The systems with devices of their own that can be there: ALSA's library has no use without its part of the kernel.
std::vector<rtaudio_api_t> runningSystems()
{
    std::vector<rtaudio_api_t> running;
    std::error_code failed;
    const bool hasAlsa = std::filesystem::exists("/proc/asound", failed);
    for (const rtaudio_api_t api : compiledSystems())
        if (api != RTAUDIO_API_LINUX_PULSE && (api != RTAUDIO_API_LINUX_ALSA || hasAlsa))
            running.push_back(api);
    return running;
}

std::string lowerCase(std::string text)
{
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// What to say of a source or a sink that PulseAudio does not know, for which it would take its default; nothing when
/// it knows it, or does not tell what it knows.
std::optional<Error> unknownAtPulse(const std::string& name, bool isInput)
{
    const auto known = pulseDevices(isInput);
    if (!known || known->empty() || name.front() == '@')
        return std::nullopt;
    std::string names;
    for (const PulseDevice& device : *known)
    {
        if (device.name == name)
            return std::nullopt;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", device.name);
    }
    return Error{ErrorCode::io, "",
                 fmt::format("is none of the {} of pulse: {}", isInput ? "sources" : "sinks", names)};
}

class RtPort final : public SoundPort
{
public:
    explicit RtPort(rtaudio_api_t api) : system(systemName(api)), audio(library().create(api))
    {
        if (audio != nullptr)
            library().showWarnings(audio, 0);
    }
    ~RtPort() override
    {
        RtPort::stop();
        if (audio != nullptr)
            library().destroy(audio);
    }
    RtPort(const RtPort&) = delete;
    RtPort& operator=(const RtPort&) = delete;

    /// Chooses the device, of which no stream is open yet.
    [[nodiscard]] Result<void> choose(const std::string& name, bool isInput, unsigned firstChannel = 0)
    {
        silent = firstChannel;
        const int count = audio != nullptr ? library().deviceCount(audio) : 0;
        if (count <= 0)
            return Error{ErrorCode::io, "",
                         system == "jack" ? "JACK does not run; start it first"
                                          : fmt::format("{} has no sound device", system)};
        std::string wanted = name;
#if defined(__linux__)
        if (system == "pulse" && !name.empty())
        {
            if (auto unknown = unknownAtPulse(name, isInput))
                return *unknown;
            // RtAudio knows one device of PulseAudio, whose library looks there for the one that is meant.
            ::setenv(isInput ? "PULSE_SOURCE" : "PULSE_SINK", name.c_str(), 1);
            wanted.clear();
        }
#endif
        std::string names;
        for (int i = 0; i < count; ++i)
        {
            const auto info = library().deviceInfo(audio, i);
            if (info.probed == 0 || (isInput ? info.input_channels : info.output_channels) == 0)
                continue;
            names += fmt::format("{}{}", names.empty() ? "" : ", ", info.name);
            const bool isDefault = (isInput ? info.is_default_input : info.is_default_output) != 0;
            const bool meant = wanted.empty() ? isDefault || !found
                                              : lowerCase(info.name).find(lowerCase(wanted)) != std::string::npos;
            if (!meant || (found && !isDefault) || info.output_channels < firstChannel)
                continue;
            found = true;
            stream.device_id = static_cast<unsigned>(i);
            stream.num_channels = isInput ? std::min(info.input_channels, 2u) : info.output_channels;
            if (info.preferred_sample_rate != 0)
                rate = info.preferred_sample_rate;
        }
        if (!found)
            return Error{ErrorCode::io, "",
                         names.empty() ? fmt::format("{} has no sound {}", system, isInput ? "input" : "output")
                                       : fmt::format("is none of the devices of {}: {}", system, names)};
        rtaudio_stream_options_t options{};
        std::string_view(isInput ? "pacini" : "pacini touch").copy(options.name, sizeof options.name - 1);
        options.flags = RTAUDIO_FLAGS_MINIMIZE_LATENCY; // of its own accord JACK is before other work
        if (system == "jack" && name.empty())
        {
            stream.num_channels = isInput ? 2 : 1;
            options.flags |= RTAUDIO_FLAGS_JACK_DONT_CONNECT;
        }
        if (library().openStream(audio, isInput ? nullptr : &stream, isInput ? &stream : nullptr,
                                 RTAUDIO_FORMAT_FLOAT32, rate, &frames, &RtPort::called, this, &options, nullptr) != 0)
            return failure();
        scratch.assign(frames, 0.0f);
        return {};
    }

    [[nodiscard]] double sampleRate() const override
    {
        return rate;
    }
    [[nodiscard]] std::size_t blockFrames() const override
    {
        return frames;
    }

    [[nodiscard]] Result<void> take(SoundTaker taker) override
    {
        takes = std::move(taker);
        return start();
    }

    [[nodiscard]] Result<void> play(SoundMaker maker) override
    {
        makes = std::move(maker);
        return start();
    }

    void stop() override
    {
        if (audio == nullptr)
            return;
        if (library().isRunning(audio) != 0)
            static_cast<void>(library().abortStream(audio));
        if (library().isOpen(audio) != 0)
            library().closeStream(audio);
    }

    [[nodiscard]] bool isRunning() override
    {
        return !gone.load(std::memory_order_relaxed) && library().isRunning(audio) != 0;
    }
    [[nodiscard]] std::uint64_t blocks() const override
    {
        return asked.load(std::memory_order_relaxed);
    }
    [[nodiscard]] std::uint64_t interruptions() const override
    {
        return late.load(std::memory_order_relaxed);
    }

private:
    [[nodiscard]] Error failure() const
    {
        const char* text = library().error(audio);
        return {ErrorCode::io, "", text != nullptr && *text != '\0' ? text : "cannot be opened"};
    }

    [[nodiscard]] Result<void> start()
    {
        if (library().startStream(audio) != 0)
            return failure();
        return {};
    }

    static int called(void* out, void* in, unsigned count, double, rtaudio_stream_status_t status, void* self)
    {
        static_cast<RtPort*>(self)->block(static_cast<float*>(out), static_cast<const float*>(in), count, status != 0);
        return 0;
    }

    void block(float* out, const float* in, std::size_t count, bool wasLate) noexcept
    {
        asked.fetch_add(1, std::memory_order_relaxed);
        if (wasLate)
            late.fetch_add(1, std::memory_order_relaxed);
        const std::size_t channels = stream.num_channels;
        // JACK's server alone calls back, and is quicker than the clock when it renders.
        if (system != "jack" && !pace.keeps(static_cast<double>(count) / rate, DevicePace::Clock::now()))
        {
            gone.store(true, std::memory_order_relaxed);
            if (out != nullptr)
                std::fill_n(out, count * channels, 0.0f);
            return;
        }
        if (in != nullptr && takes)
            takes({in, count * channels}, channels);
        if (out == nullptr)
            return;
        for (std::size_t i = 0; i < count;)
        {
            const std::size_t n = std::min(scratch.size(), count - i);
            if (makes)
                makes(std::span(scratch).first(n));
            for (std::size_t k = 0; k < n; ++k)
            {
                std::fill_n(out + (i + k) * channels, silent, 0.0f);
                std::fill_n(out + (i + k) * channels + silent, channels - silent, scratch[k]);
            }
            i += n;
        }
    }

    std::string_view system;
    rtaudio_t audio; ///< null: it could not be made
    rtaudio_stream_parameters_t stream{};
    std::size_t silent = 0; ///< channels before the first that plays
    bool found = false;
    unsigned rate = 48000; ///< Hz
    unsigned frames = 128; ///< of a block; JACK has its own
    std::vector<float> scratch;
    SoundTaker takes;
    SoundMaker makes;
    std::atomic<std::uint64_t> asked{0};
    std::atomic<std::uint64_t> late{0};
    DevicePace pace;
    std::atomic<bool> gone{false};
};

Result<std::unique_ptr<SoundPort>> openPort(const std::string& named, bool isInput)
{
    const std::size_t colon = named.find(':');
    const std::string system = named.substr(0, colon);
    const std::string name = colon == std::string::npos ? "" : named.substr(colon + 1);
    const SoundLibraryCall quiet; // what the systems' libraries print of themselves
    if (!library().isThere)
        return Error{ErrorCode::io, "", "needs RtAudio 5; install it (librtaudio6), or use a pipe"};
    for (const rtaudio_api_t api : compiledSystems())
        if (systemName(api) == system)
        {
            auto port = std::make_unique<RtPort>(api);
            if (const auto done = port->choose(name, isInput); !done)
                return done.error();
            return std::unique_ptr<SoundPort>(std::move(port));
        }
    return Error{ErrorCode::invalidArgument, "",
                 fmt::format("begins with none of {}", fmt::join(SoundPort::systems(), ", "))};
}
} // namespace

std::vector<SoundDevice> SoundPort::devices()
{
    const SoundLibraryCall quiet;
    std::vector<SoundDevice> all;
    for (const bool sources : {true, false})
        if (const auto known = pulseDevices(sources))
            for (const PulseDevice& device : *known)
                all.push_back({"pulse:" + device.name, device.description, sources ? device.channels : 0,
                               sources ? 0 : device.channels});
    for (const rtaudio_api_t api : runningSystems())
    {
        const rtaudio_t audio = library().create(api);
        if (audio == nullptr)
            continue;
        library().showWarnings(audio, 0);
        for (int i = 0, count = library().deviceCount(audio); i < count; ++i)
            if (const auto info = library().deviceInfo(audio, i); info.probed != 0)
                all.push_back({fmt::format("{}:{}", systemName(api), info.name), "",
                               static_cast<int>(info.input_channels), static_cast<int>(info.output_channels)});
        library().destroy(audio);
    }
    return all;
}

Result<std::unique_ptr<SoundPort>> SoundPort::openDualSense(int card)
{
    constexpr int coils = 2; // channels before them
    if (const auto sinks = pulseDevices(false))
        for (const PulseDevice& sink : *sinks)
            if (sink.card == card && sink.channels >= coils + 2)
                return openPulseSurround(sink.name);
    const SoundLibraryCall quiet;
    for (const rtaudio_api_t api : runningSystems())
        if (api == RTAUDIO_API_LINUX_ALSA)
            for (const char* const name : {"DualSense", "Wireless Controller"})
            {
                auto port = std::make_unique<RtPort>(api);
                if (port->choose(name, false, coils))
                    return std::unique_ptr<SoundPort>(std::move(port));
            }
    return Error{ErrorCode::io, "", "cannot be opened with four channels"};
}

std::vector<std::string> SoundPort::systems()
{
    std::vector<std::string> names;
    for (const rtaudio_api_t api : compiledSystems())
        names.emplace_back(systemName(api));
    return names;
}

#else

namespace
{
Result<std::unique_ptr<SoundPort>> openPort(const std::string&, bool)
{
    return Error{ErrorCode::io, "", "needs RtAudio 5, without which this pacini was built; use a pipe"};
}
} // namespace

std::vector<SoundDevice> SoundPort::devices()
{
    return {};
}

Result<std::unique_ptr<SoundPort>> SoundPort::openDualSense(int)
{
    return Error{ErrorCode::io, "", "needs RtAudio 5, without which this pacini was built"};
}

std::vector<std::string> SoundPort::systems()
{
    return {};
}

#endif

Result<std::unique_ptr<SoundPort>> SoundPort::openInput(const std::string& named)
{
    return openPort(named, true);
}

Result<std::unique_ptr<SoundPort>> SoundPort::openOutput(const std::string& named)
{
    return openPort(named, false);
}

} // namespace pacini::live
