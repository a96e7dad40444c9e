#include "cli/live/SoundPort.h"

#include "io/SoundHandle.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <utility>

#if defined(PACINI_HAS_RTAUDIO)
#include <RtAudio.h>
#endif

namespace pacini::cli
{

#if defined(PACINI_HAS_RTAUDIO)

namespace
{
std::string systemName(RtAudio::Api api)
{
    switch (api)
    {
    case RtAudio::UNIX_JACK:
        return "jack";
    case RtAudio::LINUX_PULSE:
        return "pulse";
    case RtAudio::LINUX_ALSA:
        return "alsa";
    case RtAudio::MACOSX_CORE:
        return "core";
    case RtAudio::WINDOWS_WASAPI:
        return "wasapi";
    default:
        return "";
    }
}

std::vector<RtAudio::Api> compiledSystems()
{
    std::vector<RtAudio::Api> all, named;
    RtAudio::getCompiledApi(all);
    std::copy_if(all.begin(), all.end(), std::back_inserter(named),
                 [](RtAudio::Api api) { return !systemName(api).empty(); });
    return named;
}

std::string lowerCase(std::string text)
{
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

class RtPort final : public SoundPort
{
public:
    explicit RtPort(RtAudio::Api api) : audio(api) { audio.showWarnings(false); }
    ~RtPort() override { RtPort::stop(); }

    /// Chooses the device, of which no stream is open yet.
    [[nodiscard]] Result<void> choose(const std::string& name, bool isInput)
    {
        input = isInput;
        system = systemName(audio.getCurrentApi());
        const unsigned count = audio.getDeviceCount();
        if (count == 0)
            return Error{ErrorCode::io, "",
                         system == "jack" ? "JACK does not run; start it first" : system + " has no sound device"};
        std::string wanted = name;
#if defined(__linux__)
        if (system == "pulse" && !name.empty())
        {
            // RtAudio knows one device of PulseAudio, whose library looks there for the one that is meant.
            ::setenv(isInput ? "PULSE_SOURCE" : "PULSE_SINK", name.c_str(), 1);
            wanted.clear();
        }
#endif
        std::string names;
        for (unsigned i = 0; i < count; ++i)
        {
            const auto info = audio.getDeviceInfo(i);
            if (!info.probed || (isInput ? info.inputChannels : info.outputChannels) == 0)
                continue;
            names += (names.empty() ? "" : ", ") + info.name;
            const bool isDefault = isInput ? info.isDefaultInput : info.isDefaultOutput;
            const bool meant = wanted.empty() ? isDefault || !found
                                              : lowerCase(info.name).find(lowerCase(wanted)) != std::string::npos;
            if (!meant || (found && !isDefault))
                continue;
            found = true;
            stream.deviceId = i;
            stream.nChannels = isInput ? std::min(info.inputChannels, 2u) : info.outputChannels;
            rate = info.preferredSampleRate != 0 ? info.preferredSampleRate
                   : info.sampleRates.empty()    ? 48000
                                                 : info.sampleRates.back();
        }
        if (!found)
            return Error{ErrorCode::io, "",
                         names.empty() ? fmt::format("{} has no sound {}", system, isInput ? "input" : "output")
                                       : fmt::format("is none of the devices of {}: {}", system, names)};
        if (system == "jack" && name.empty())
            stream.nChannels = isInput ? 2 : 1;
        RtAudio::StreamOptions options;
        options.streamName = isInput ? "pacini" : "pacini touch";
        options.flags = RTAUDIO_MINIMIZE_LATENCY; // of its own accord JACK is before other work
        if (system == "jack" && name.empty())
            options.flags |= RTAUDIO_JACK_DONT_CONNECT;
        audio.openStream(isInput ? nullptr : &stream, isInput ? &stream : nullptr, RTAUDIO_FLOAT32, rate, &frames,
                         &RtPort::called, this, &options);
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
        try
        {
            if (audio.isStreamRunning())
                audio.abortStream();
            if (audio.isStreamOpen())
                audio.closeStream();
        }
        catch (const RtAudioError&)
        {
            return; // it is gone, and calls nobody
        }
    }

    [[nodiscard]] bool isRunning() override
    {
        return audio.isStreamRunning();
    }
    [[nodiscard]] std::uint64_t interruptions() const override
    {
        return late.load(std::memory_order_relaxed);
    }

private:
    [[nodiscard]] Result<void> start()
    {
        try
        {
            audio.startStream();
        }
        catch (const RtAudioError& error)
        {
            return Error{ErrorCode::io, "", error.getMessage()};
        }
        return {};
    }

    static int called(void* out, void* in, unsigned count, double, RtAudioStreamStatus status, void* self)
    {
        static_cast<RtPort*>(self)->block(static_cast<float*>(out), static_cast<const float*>(in), count, status != 0);
        return 0;
    }

    void block(float* out, const float* in, std::size_t count, bool wasLate) noexcept
    {
        if (wasLate)
            late.fetch_add(1, std::memory_order_relaxed);
        const std::size_t channels = stream.nChannels;
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
                std::fill_n(out + (i + k) * channels, channels, scratch[k]);
            i += n;
        }
    }

    RtAudio audio;
    RtAudio::StreamParameters stream;
    std::string system;
    bool input = false;
    bool found = false;
    unsigned rate = 48000; ///< Hz
    unsigned frames = 128; ///< of a block; JACK has its own
    std::vector<float> scratch;
    SoundTaker takes;
    SoundMaker makes;
    std::atomic<std::uint64_t> late{0};
};

Result<std::unique_ptr<SoundPort>> openPort(const std::string& named, bool isInput)
{
    const std::size_t colon = named.find(':');
    const std::string system = named.substr(0, colon);
    const std::string name = colon == std::string::npos ? "" : named.substr(colon + 1);
    for (const RtAudio::Api api : compiledSystems())
        if (systemName(api) == system)
        {
            const SoundLibraryCall quiet; // what the systems' libraries print of themselves
            try
            {
                auto port = std::make_unique<RtPort>(api);
                if (const auto done = port->choose(name, isInput); !done)
                    return done.error();
                return std::unique_ptr<SoundPort>(std::move(port));
            }
            catch (const RtAudioError& error)
            {
                return Error{ErrorCode::io, "", error.getMessage()};
            }
        }
    return Error{ErrorCode::invalidArgument, "",
                 fmt::format("begins with none of {}", fmt::join(SoundPort::systems(), ", "))};
}
} // namespace

std::vector<std::string> SoundPort::systems()
{
    std::vector<std::string> names;
    for (const RtAudio::Api api : compiledSystems())
        names.push_back(systemName(api));
    return names;
}

#else

namespace
{
Result<std::unique_ptr<SoundPort>> openPort(const std::string&, bool)
{
    return Error{ErrorCode::io, "", "needs RtAudio, without which this pacini was built; use a pipe"};
}
} // namespace

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

} // namespace pacini::cli
