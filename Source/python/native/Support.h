#pragma once

// Shared parts of the Python module: errors as exceptions, conversion of arrays, work without the interpreter's
// lock.

#include <pacini/analysis/EncodeSound.h>
#include <pacini/foundation/Result.h>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace pacini::python
{

namespace nb = nanobind;
using namespace nanobind::literals;

/// Raises pacini.Error. With the lock.
[[noreturn]] void raise(const Error& error);

/// Raises pacini.Error at a place in a file, whose name stays as it is. With the lock.
[[noreturn]] void raiseIn(const std::filesystem::path& path, const Error& error);

/// The value, or pacini.Error. With the lock.
template <typename T>
T take(Result<T>&& result)
{
    if (!result)
        raise(result.error());
    if constexpr (!std::is_void_v<T>)
        return std::move(result).value();
}

/// The value, or pacini.Error at a place in the file. With the lock.
template <typename T>
T takeIn(const std::filesystem::path& path, Result<T>&& result)
{
    if (!result)
        raiseIn(path, result.error());
    return std::move(result).value();
}

/// Runs `work` without the lock and returns its result.
template <typename Work>
auto unlocked(Work&& work)
{
    nb::gil_scoped_release released;
    return work();
}

/// Handles Ctrl+C and shows progress during work without the lock. It is called with the share that is done, and takes
/// the lock ten times a second. Created and destroyed with the lock.
class Watch
{
public:
    /// `progress` is None or takes the share.
    explicit Watch(nb::object progress) : shown(std::move(progress)) {}

    /// Throws the interpreter's pending exception.
    void operator()(double share);

private:
    nb::object shown;
    std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
};

/// Whether this is the thread that Ctrl+C comes to.
[[nodiscard]] bool isMainThread();

/// Counts abandoned threads, so that the process does not end while they work.
class AbandonedWork
{
public:
    static void begin() noexcept;
    static void end() noexcept;

    /// Blocks until no such call runs. Releases the GIL.
    static void wait();
};

/// Runs `work` without the lock and returns its result; Ctrl+C abandons it. For work that cannot be stopped: it owns
/// all its data and does not access Python objects.
template <typename Work>
auto abandonable(Work work)
{
    using R = std::invoke_result_t<Work&>;
    if (!isMainThread())
        return unlocked(work);
    struct Job
    {
        explicit Job(Work&& given) : work(std::move(given)) {}
        Work work;
        std::mutex mutex;
        std::condition_variable changed;
        bool done = false;
        std::optional<R> result;
        std::exception_ptr failure;
    };
    const auto job = std::make_shared<Job>(std::move(work));
    const auto run = [job]
    {
        std::optional<R> result;
        std::exception_ptr failure;
        try
        {
            result.emplace(job->work());
        }
        catch (...)
        {
            failure = std::current_exception();
        }
        const std::scoped_lock lock(job->mutex);
        job->result = std::move(result);
        job->failure = failure;
        job->done = true;
        job->changed.notify_all();
    };
    AbandonedWork::begin();
    try
    {
        std::thread(
            [run]
            {
                run();
                AbandonedWork::end();
            })
            .detach();
    }
    catch (const std::system_error&)
    {
        unlocked(run); // no thread to be had
        AbandonedWork::end();
    }
    for (;;)
    {
        const bool done = unlocked(
            [&]
            {
                std::unique_lock lock(job->mutex);
                return job->changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return job->done; });
            });
        if (done)
            break;
        if (PyErr_CheckSignals() != 0)
            throw nb::python_error();
    }
    if (job->failure)
        std::rethrow_exception(job->failure);
    return std::move(*job->result);
}

/// Samples as they come: (frames,) or (channels, frames), float32 or float64, any strides.
using SoundArray = nb::ndarray<nb::ro, nb::device::cpu>;

/// A sound in an array of Python, which must outlive it.
struct SoundView
{
    const void* data = nullptr;
    bool isDouble = false;
    std::size_t channels = 1;
    std::size_t frames = 0;
    std::int64_t channelStride = 0; ///< in samples
    std::int64_t frameStride = 1;

    /// Whether its samples lie in memory as files have them, interleaved.
    [[nodiscard]] bool isInterleaved() const noexcept
    {
        return !isDouble && frameStride == static_cast<std::int64_t>(channels) && (channels == 1 || channelStride == 1);
    }

    [[nodiscard]] float at(std::size_t channel, std::size_t frame) const noexcept
    {
        const std::int64_t i =
            static_cast<std::int64_t>(channel) * channelStride + static_cast<std::int64_t>(frame) * frameStride;
        return isDouble ? static_cast<float>(static_cast<const double*>(data)[i]) : static_cast<const float*>(data)[i];
    }
};

/// Raises pacini.Error unless the array is one that SoundArray describes, of 1 to 64 channels.
[[nodiscard]] SoundView soundOf(const SoundArray& array);

/// Treatment of samples that are not finite or absurdly large.
enum class Unsound
{
    refuse,
    silence, ///< 0 instead
    keep
};

/// A sound in an array, part by part as it is read from a file; without a copy where its samples are interleaved.
/// Errors: notFinite. Without the lock.
class ArrayParts
{
public:
    ArrayParts(const SoundView& view, Unsound treatment, Watch& toWatch)
        : sound(view), unsound(treatment), watch(toWatch)
    {
    }

    [[nodiscard]] SoundPart operator()();

    [[nodiscard]] std::uint64_t replacedSamples() const noexcept { return replaced; }

private:
    [[nodiscard]] std::optional<Error> repair(std::span<float> part);

    SoundView sound;
    Unsound unsound;
    Watch& watch;
    std::size_t position = 0; ///< frames given out
    std::uint64_t replaced = 0;
    std::vector<float> buffer;
};

/// The mean of all channels, as comparisons have it.
[[nodiscard]] std::vector<float> monoOf(const SoundView& sound);

/// An array that owns `values`, with this shape.
template <typename T>
[[nodiscard]] nb::object toArray(std::vector<T>&& values, std::initializer_list<std::size_t> shape)
{
    auto owned = std::make_unique<std::vector<T>>(std::move(values));
    T* data = owned->data();
    static T nothing{}; // arrays without samples want an address, too
    nb::capsule owner(owned.get(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    static_cast<void>(owned.release());
    return nb::cast(nb::ndarray<nb::numpy, T>(data != nullptr ? data : &nothing, shape, owner));
}

template <typename T>
[[nodiscard]] nb::object toArray(std::vector<T>&& values)
{
    const std::size_t size = values.size();
    return toArray(std::move(values), {size});
}

// The parts of the module.
void bindClip(nb::module_& module);
void bindEncode(nb::module_& module);
void bindRender(nb::module_& module);
void bindCompare(nb::module_& module);
void bindProfile(nb::module_& module);
void bindMeasure(nb::module_& module);
void bindTranslator(nb::module_& module);
void bindTextures(nb::module_& module);
void bindAudio(nb::module_& module);

} // namespace pacini::python
