#include "live/PulseServer.h"

#include "io/SoundLibraryCall.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <span>
#include <thread>
#include <utility>

#if defined(PACINI_HAS_PULSE)
#include "live/OpenedLibrary.h"

#include <pulse/pulseaudio.h>
#include <pulse/simple.h>
#endif

namespace pacini::live
{

#if defined(PACINI_HAS_PULSE)

namespace
{
Error missing()
{
    return {ErrorCode::io, "", "needs PulseAudio's library; install it (libpulse0)"};
}

struct PulseLibrary : OpenedLibrary
{
    PulseLibrary() : OpenedLibrary("libpulse.so.0")
    {
        find(newLoop, "pa_mainloop_new");
        find(freeLoop, "pa_mainloop_free");
        find(loopApi, "pa_mainloop_get_api");
        find(iterate, "pa_mainloop_iterate");
        find(newContext, "pa_context_new");
        find(unrefContext, "pa_context_unref");
        find(connect, "pa_context_connect");
        find(disconnect, "pa_context_disconnect");
        find(stateOf, "pa_context_get_state");
        find(listSinks, "pa_context_get_sink_info_list");
        find(listSources, "pa_context_get_source_info_list");
        find(operationState, "pa_operation_get_state");
        find(unrefOperation, "pa_operation_unref");
        find(property, "pa_proplist_gets");
    }

    decltype(&pa_mainloop_new) newLoop;
    decltype(&pa_mainloop_free) freeLoop;
    decltype(&pa_mainloop_get_api) loopApi;
    decltype(&pa_mainloop_iterate) iterate;
    decltype(&pa_context_new) newContext;
    decltype(&pa_context_unref) unrefContext;
    decltype(&pa_context_connect) connect;
    decltype(&pa_context_disconnect) disconnect;
    decltype(&pa_context_get_state) stateOf;
    decltype(&pa_context_get_sink_info_list) listSinks;
    decltype(&pa_context_get_source_info_list) listSources;
    decltype(&pa_operation_get_state) operationState;
    decltype(&pa_operation_unref) unrefOperation;
    decltype(&pa_proplist_gets) property;
};

struct SimpleLibrary : OpenedLibrary
{
    SimpleLibrary() : OpenedLibrary("libpulse-simple.so.0")
    {
        find(open, "pa_simple_new");
        find(write, "pa_simple_write");
        find(flush, "pa_simple_flush");
        find(close, "pa_simple_free");
    }

    decltype(&pa_simple_new) open;
    decltype(&pa_simple_write) write;
    decltype(&pa_simple_flush) flush;
    decltype(&pa_simple_free) close;
};

const PulseLibrary& pulse()
{
    return openedLibrary<PulseLibrary>();
}

const SimpleLibrary& simple()
{
    return openedLibrary<SimpleLibrary>();
}

template <typename Info>
void note(pa_context*, const Info* info, int isLast, void* list)
{
    if (isLast != 0 || info == nullptr)
        return;
    PulseDevice device{info->name, info->description != nullptr ? info->description : "", info->sample_spec.channels};
    if (const char* const card = pulse().property(info->proplist, "alsa.card"))
        device.card = std::atoi(card);
    static_cast<std::vector<PulseDevice>*>(list)->push_back(std::move(device));
}

/// A connection to the server, which ends with it.
class Connection
{
public:
    Connection() : loop(pulse().newLoop()), context(pulse().newContext(pulse().loopApi(loop), "pacini")) {}
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection()
    {
        pulse().disconnect(context);
        pulse().unrefContext(context);
        pulse().freeLoop(loop);
    }

    /// Goes on until `done`, or for 3 s.
    template <typename Done>
    [[nodiscard]] bool waitFor(const Done& done)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
        while (!done())
        {
            const int handled = pulse().iterate(loop, 0, nullptr);
            if (handled < 0 || std::chrono::steady_clock::now() > end)
                return false;
            if (handled == 0)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }

    [[nodiscard]] bool connect()
    {
        if (pulse().connect(context, nullptr, PA_CONTEXT_NOAUTOSPAWN, nullptr) < 0)
            return false;
        return waitFor([&] { return pulse().stateOf(context) >= PA_CONTEXT_READY; }) &&
               pulse().stateOf(context) == PA_CONTEXT_READY;
    }

    [[nodiscard]] bool list(bool sources, std::vector<PulseDevice>& devices)
    {
        pa_operation* const asked = sources ? pulse().listSources(context, &note<pa_source_info>, &devices)
                                            : pulse().listSinks(context, &note<pa_sink_info>, &devices);
        if (asked == nullptr)
            return false;
        const bool answered = waitFor([&] { return pulse().operationState(asked) != PA_OPERATION_RUNNING; });
        pulse().unrefOperation(asked);
        return answered;
    }

private:
    pa_mainloop* loop;
    pa_context* context;
};

class SurroundPort final : public SoundPort
{
public:
    explicit SurroundPort(pa_simple* opened) : stream(opened) {}
    SurroundPort(const SurroundPort&) = delete;
    SurroundPort& operator=(const SurroundPort&) = delete;
    ~SurroundPort() override
    {
        SurroundPort::stop();
        simple().close(stream);
    }

    [[nodiscard]] double sampleRate() const override { return rate; }
    [[nodiscard]] std::size_t blockFrames() const override { return frames; }

    [[nodiscard]] Result<void> take(SoundTaker) override
    {
        return Error{ErrorCode::invalidArgument, "", "is no input"};
    }

    [[nodiscard]] Result<void> play(SoundMaker maker) override
    {
        running.store(true);
        thread = std::thread([this, makes = std::move(maker)] { run(makes); });
        return {};
    }

    void stop() override
    {
        running.store(false);
        if (thread.joinable())
            thread.join();
    }

    [[nodiscard]] bool isRunning() override { return running.load(); }
    [[nodiscard]] std::uint64_t blocks() const override { return written.load(std::memory_order_relaxed); }
    [[nodiscard]] std::uint64_t interruptions() const override { return 0; }

    static constexpr std::uint32_t rate = 48000; // Hz
    static constexpr std::size_t frames = 128;
    static constexpr std::size_t channels = 4;

private:
    void run(const SoundMaker& makes)
    {
        std::array<float, frames> made{};
        std::array<float, frames * channels> block{};
        while (running.load())
        {
            makes(made);
            for (std::size_t i = 0; i < frames; ++i)
                block[channels * i + 2] = block[channels * i + 3] = std::clamp(made[i], -1.0f, 1.0f);
            if (simple().write(stream, block.data(), sizeof block, nullptr) < 0)
                running.store(false);
            written.fetch_add(1, std::memory_order_relaxed);
        }
        simple().flush(stream, nullptr); // silent at once
    }

    pa_simple* stream;
    std::atomic<bool> running{false};
    std::atomic<std::uint64_t> written{0};
    std::thread thread;
};
} // namespace

Result<std::vector<PulseDevice>> pulseDevices(bool sources)
{
    const SoundLibraryCall quiet;
    if (!pulse().isThere)
        return missing();
    Connection connection;
    std::vector<PulseDevice> devices;
    if (!connection.connect() || !connection.list(sources, devices))
        return Error{ErrorCode::io, "", "PulseAudio does not run; start it first"};
    return devices;
}

Result<std::unique_ptr<SoundPort>> openPulseSurround(const std::string& sink)
{
    const SoundLibraryCall quiet;
    if (!simple().isThere)
        return missing();
    const pa_sample_spec form{PA_SAMPLE_FLOAT32LE, SurroundPort::rate, SurroundPort::channels};
    pa_channel_map places{SurroundPort::channels,
                          {PA_CHANNEL_POSITION_FRONT_LEFT, PA_CHANNEL_POSITION_FRONT_RIGHT,
                           PA_CHANNEL_POSITION_REAR_LEFT, PA_CHANNEL_POSITION_REAR_RIGHT}};
    constexpr std::uint32_t unset = ~std::uint32_t{0};
    constexpr std::uint32_t block = SurroundPort::channels * sizeof(float) * SurroundPort::frames;
    constexpr std::uint32_t queued = 8 * block;                      // 21 ms
    const pa_buffer_attr buffer{unset, queued, block, block, unset}; // goes on with the first block after a gap
    pa_simple* const stream =
        simple().open(nullptr, "pacini", PA_STREAM_PLAYBACK, sink.c_str(), "touch", &form, &places, &buffer, nullptr);
    if (stream == nullptr)
        return Error{ErrorCode::io, "", fmt::format("{} cannot be opened", sink)};
    return std::unique_ptr<SoundPort>(std::make_unique<SurroundPort>(stream));
}

#else

namespace
{
Error missing()
{
    return {ErrorCode::io, "", "needs PulseAudio's library, without which this pacini was built"};
}
} // namespace

Result<std::vector<PulseDevice>> pulseDevices(bool)
{
    return missing();
}

Result<std::unique_ptr<SoundPort>> openPulseSurround(const std::string&)
{
    return missing();
}

#endif

} // namespace pacini::live
