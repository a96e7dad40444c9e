// The C functions of pacini.h: handles to objects, errors to codes and texts, exceptions to errors.

#define PACINI_BUILDING 1

#include "pacini.h"

#include "io/ClipFile.h"
#include "io/InputFile.h"
#include "io/ProfileJson.h"
#include "io/SceneFile.h"
#include "io/ShippedProfiles.h"
#include "io/TextureFile.h"
#include "io/formats/ClipFormat.h"
#include "library/ControllerLink.h"
#include "library/Handles.h"
#include "library/RenderEngine.h"

#include <pacini/foundation/SnakeCase.h>
#include <pacini/runtime/Engine.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace
{
using namespace pacini;
using library::Handle;
using library::HandleKind;
using library::PlayHandle;
using library::renderEngine;

constexpr std::size_t mostEngines = 64; // 6 bits of a play's handle
constexpr std::size_t mostClips = 1'000'000;
constexpr std::size_t mostTextures = 10'000;
constexpr std::size_t mostControllers = 1024;
constexpr std::uint32_t blockFrames = 256; // of interleaved output at a time

constexpr std::uint32_t timedBlocks = 256;

thread_local std::string lastError;

struct EngineEntry
{
    std::unique_ptr<Engine> engine;
    std::array<std::array<float, blockFrames>, PACINI_MAX_ACTUATORS> channels{}; // [audio]
    // Time that plays may take, and by which factor they take longer here than predicted.
    double budget = 0.0; ///< us for `budgetFrames`
    std::uint32_t budgetFrames = 512, budgetVoices = 0;
    double timeFactor = 1.0;
    std::array<std::atomic<float>, timedBlocks> ratios{}; ///< of the last blocks with plays, by renderTimed() [audio]
    std::atomic<std::uint32_t> timed{0};                  ///< how many there were [audio]
    std::uint32_t actuators = 1;
    double sampleRate = 0.0;

    // Of two threads that render only one may: the caller's says that it does, the other that it will.
    std::atomic<bool> rendering{false};
    std::atomic<bool> pulled{false}; ///< by a controller
    std::unique_ptr<library::ControllerLink> link;
    pacini_controller controller = PACINI_NONE;
};

/// All objects of the library. Never destroyed, as an audio thread may outlive main().
struct Library
{
    std::mutex control; ///< of everything but `engines` while rendering
    library::HandleTable<std::shared_ptr<const LoadedClip>> clips{HandleKind::clip, mostClips};
    library::HandleTable<std::shared_ptr<const Texture>> textures{HandleKind::texture, mostTextures};
    library::SharedSlots<EngineEntry, mostEngines> engines;
    library::HandleTable<devices::Controller> controllers{HandleKind::controller, mostControllers};
    std::vector<pacini_controller> connected; ///< of `controllers`
};

Library& all()
{
    static Library* const library = new Library;
    return *library;
}

pacini_result fail(pacini_result code, std::string text)
{
    lastError = std::move(text);
    return code;
}

pacini_result codeOf(ErrorCode code)
{
    switch (code)
    {
    case ErrorCode::invalidArgument:
        return PACINI_INVALID;
    case ErrorCode::unsupportedVersion:
        return PACINI_NEWER;
    case ErrorCode::tooLarge:
        return PACINI_TOO_MANY;
    case ErrorCode::io:
    case ErrorCode::diskFull:
        return PACINI_IO;
    case ErrorCode::invalidData:
    case ErrorCode::truncated:
    case ErrorCode::notFinite:
        return PACINI_BAD_DATA;
    case ErrorCode::cancelled: // nothing here can be
        break;
    }
    return PACINI_INTERNAL;
}

pacini_result fail(const Error& error, std::string_view what = {})
{
    std::string text(what);
    // An argument is called as in pacini.h; what is in a file, as the file has it.
    const std::string where = error.code == ErrorCode::invalidArgument ? snakeCase(error.where) : error.where;
    for (const std::string& part : {where, error.message})
        if (!part.empty())
            text += (text.empty() ? "" : ": ") + part;
    return fail(codeOf(error.code), std::move(text));
}

pacini_result stale(const char* what)
{
    return fail(PACINI_STALE, std::string(what) + " is not in use (any more)");
}

pacini_result noMemory() noexcept
{
    lastError.assign("out of memory"); // short enough to be kept without an allocation
    return PACINI_NO_MEMORY;
}

/// Runs code that may allocate; turns all exceptions into a code.
template <typename Work>
pacini_result guarded(Work&& work) noexcept
{
    try
    {
        return work();
    }
    catch (const std::bad_alloc&)
    {
        return noMemory();
    }
    catch (const std::exception& error)
    {
        try
        {
            return fail(PACINI_INTERNAL, error.what());
        }
        catch (...)
        {
            return noMemory();
        }
    }
    catch (...)
    {
        lastError.clear();
        return PACINI_INTERNAL;
    }
}

// Structs of the interface begin with their size: those of callers may be older and shorter.

bool isSize(std::uint32_t size)
{
    return size >= sizeof(size) && size <= 4096;
}

/// Zeros and its size for a struct of `size` bytes; null is left alone.
[[gnu::noinline]] void beginBytes(void* bytes, std::uint32_t size)
{
    if (bytes == nullptr)
        return;
    std::memset(bytes, 0, size);
    std::memcpy(bytes, &size, sizeof(size));
}

[[gnu::noinline]] bool readBytes(const void* from, void* to, std::uint32_t known)
{
    if (from == nullptr)
        return true;
    std::uint32_t size = 0;
    std::memcpy(&size, from, sizeof(size));
    if (!isSize(size))
        return false;
    std::memcpy(to, from, std::min(size, known));
    return true;
}

[[gnu::noinline]] pacini_result writeBytes(const void* from, void* to, std::uint32_t known)
{
    std::uint32_t size = 0;
    if (to != nullptr)
        std::memcpy(&size, to, sizeof(size));
    if (!isSize(size))
        return fail(PACINI_INVALID, "info: call its init function first");
    std::memcpy(to, from, std::min(size, known));
    std::memcpy(to, &size, sizeof(size));
    return PACINI_OK;
}

template <typename Struct>
void beginStruct(Struct* made)
{
    static_assert(offsetof(Struct, struct_size) == 0);
    beginBytes(made, sizeof(Struct));
}

/// The fields of the caller's struct, with those of `to` for the rest.
template <typename Struct>
bool readStruct(const Struct* from, Struct& to)
{
    return readBytes(from, &to, sizeof(Struct));
}

/// Writes the fields that fit into the caller's struct.
template <typename Struct>
pacini_result writeStruct(const Struct& from, Struct* to)
{
    return writeBytes(&from, to, sizeof(Struct));
}

std::span<const std::byte> bytesOf(std::string_view text)
{
    return std::as_bytes(std::span(text.data(), text.size()));
}

Result<std::shared_ptr<const LoadedClip>> loadClip(std::string_view bytes, std::string_view extension)
{
    const ClipFormat* format = clipFormatOf(extension, bytes);
    if (format == nullptr || !format->isRead())
        return Error{ErrorCode::invalidData, "", "is not a clip that Pacini reads"};
    if (format == &packedFormat())
        return LoadedClip::ofPacked(bytesOf(bytes));
    auto read = format->read(bytes);
    if (!read)
        return read.error();
    return LoadedClip::ofClip(read->clip);
}

pacini_result addClip(const std::shared_ptr<const LoadedClip>& clip, pacini_clip* handle)
{
    const std::lock_guard lock(all().control);
    const std::uint64_t added = all().clips.add(clip);
    if (added == 0)
        return fail(PACINI_TOO_MANY, "a million clips are loaded: release some");
    *handle = {added};
    return PACINI_OK;
}

/// `path`: of its file, if it is of one.
pacini_result addTexture(Result<Texture>&& read, std::string_view path, pacini_texture* handle)
{
    if (!read)
        return fail(read.error(), path);
    auto texture = std::make_shared<const Texture>(std::move(read).value());
    const std::lock_guard lock(all().control);
    const std::uint64_t added = all().textures.add(std::move(texture));
    if (added == 0)
        return fail(PACINI_TOO_MANY, "10000 textures are loaded: release some");
    *handle = {added};
    return PACINI_OK;
}

Result<std::optional<Profile>> profileOf(const char* text)
{
    if (text == nullptr || *text == '\0')
        return std::optional<Profile>();
    const std::string_view given(text);
    if (given.find('{') != std::string_view::npos)
    {
        auto read = readProfileJson(given);
        if (!read)
            return read.error();
        return std::optional<Profile>(std::move(read).value());
    }
    std::string names;
    for (std::size_t slot = 0; !profileNameOf(slot).empty(); ++slot)
    {
        if (profileNameOf(slot) == given)
            return builtInProfile(slot);
        names += (names.empty() ? "" : ", ") + std::string(profileNameOf(slot));
    }
    return Error{ErrorCode::invalidArgument, "",
                 "'" + std::string(given) + "' is no profile that comes with Pacini; there are " + names};
}

/// A budget of us as the engine has it: of predicted ns, which last `factor` times as long.
EngineBudget budgetOf(double microseconds, std::uint32_t frames, std::uint32_t voices, double factor)
{
    constexpr double most = 1e9;
    return {std::min(most, 1e3 * microseconds / static_cast<double>(frames) / factor), voices};
}

pacini_result createEngine(const pacini_engine_config* given, const Scene* scene, pacini_engine* handle)
{
    pacini_engine_config config;
    pacini_engine_config_init(&config);
    if (handle == nullptr)
        return fail(PACINI_INVALID, "engine: is NULL");
    if (!readStruct(given, config))
        return fail(PACINI_INVALID, "config: call pacini_engine_config_init() first");
    if (config.actuator_count < 1 || config.actuator_count > PACINI_MAX_ACTUATORS)
        return fail(PACINI_INVALID, "actuator_count: must be 1 to 16");
    if (config.pan_law < PACINI_PAN_POWER || config.pan_law > PACINI_PAN_BOTH)
        return fail(PACINI_INVALID, "pan_law: must be a pacini_pan_law");
    if (!(config.budget >= 0.0 && config.budget <= 1e6) || config.budget_frames < 1)
        return fail(PACINI_INVALID, "budget: must be 0 to 1e6 microseconds for 1 frame or more");
    if (!(config.strength >= 0.0 && config.strength <= 1.0))
        return fail(PACINI_INVALID, "strength: must be 0 to 1");
    EngineParams params;
    params.sampleRate = config.sample_rate;
    params.panLaw = static_cast<PanLaw>(config.pan_law);
    params.protect = config.protect != 0;
    params.panDelay = Seconds(config.pan_delay);
    params.longestDelay = Seconds(config.longest_delay);
    params.adaptation.strength = config.strength;
    params.maxPlays = config.max_plays;
    params.maxCommands = config.max_commands;
    params.budget = budgetOf(config.budget, config.budget_frames, config.budget_voices, 1.0);
    if (scene != nullptr)
    {
        params.panLaw = scene->panLaw;
        params.panDelay = Seconds(scene->panDelay);
    }
    for (std::uint32_t a = 0; a < config.actuator_count; ++a)
    {
        auto profile = profileOf(config.actuators[a].profile);
        if (!profile)
            return fail(profile.error(), "actuators[" + std::to_string(a) + "].profile");
        params.actuators.push_back(
            {std::move(profile).value(), config.actuators[a].gain, Seconds(config.actuators[a].delay)});
    }
    auto engine = Engine::make(params, scene);
    if (!engine)
        return fail(engine.error());
    auto entry = std::make_unique<EngineEntry>();
    entry->engine = std::move(engine).value();
    entry->budget = config.budget;
    entry->budgetFrames = config.budget_frames;
    entry->budgetVoices = config.budget_voices;
    entry->actuators = config.actuator_count;
    entry->sampleRate = config.sample_rate;
    const std::lock_guard lock(all().control);
    const auto [index, generation] = all().engines.add(entry.get());
    if (index == mostEngines)
        return fail(PACINI_TOO_MANY, "64 engines are in use: destroy some");
    static_cast<void>(entry.release()); // the slots have it
    *handle = {Handle{HandleKind::engine, index, generation}.number()};
    return PACINI_OK;
}

constexpr double leastFactor = 0.01, largestFactor = 100.0;

/// Gives the engine its budget, and keeps what it is of.
pacini_result setBudget(EngineEntry& entry, double microseconds, std::uint32_t frames, std::uint32_t voices,
                        double factor)
{
    const auto done = entry.engine->setBudget(budgetOf(microseconds, frames, voices, factor));
    if (!done)
        return fail(done.error());
    entry.budget = microseconds;
    entry.budgetFrames = frames;
    entry.budgetVoices = voices;
    entry.timeFactor = factor;
    return PACINI_OK;
}

/// Renders a block, and notes what it took over what was predicted. [audio]
void renderTimed(EngineEntry& entry, std::span<const std::span<float>> out) noexcept
{
    const auto start = std::chrono::steady_clock::now();
    renderEngine(*entry.engine, out);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    const EngineMeters meters = entry.engine->meters();
    if (meters.playing == 0 || out.empty() || !(meters.cost > 0.0))
        return;
    const std::uint32_t n = entry.timed.load(std::memory_order_relaxed);
    const double ratio = taken.count() / (meters.cost * static_cast<double>(out.front().size()));
    entry.ratios[n % timedBlocks].store(static_cast<float>(ratio), std::memory_order_relaxed);
    entry.timed.store(n + 1, std::memory_order_release);
}

/// The ratio that nine in ten of the last blocks do not exceed; 0 of too few blocks.
double measuredFactor(const EngineEntry& entry)
{
    constexpr std::uint32_t fewest = 64;
    const std::uint32_t n = std::min<std::uint32_t>(entry.timed.load(std::memory_order_acquire), timedBlocks);
    float found = 0.0f;
    for (std::uint32_t i = 0; n >= fewest && i < n; ++i)
    {
        const float ratio = entry.ratios[i].load(std::memory_order_relaxed);
        std::uint32_t below = 0;
        for (std::uint32_t k = 0; k < n; ++k)
            below += entry.ratios[k].load(std::memory_order_relaxed) < ratio ? 1u : 0u;
        if (10 * below <= 9 * n)
            found = std::max(found, ratio);
    }
    return static_cast<double>(found);
}

using EngineUse = library::SharedSlots<EngineEntry, mostEngines>::Use;

/// The engine of a handle while this lives; generation 0 for a handle of another kind, which finds none.
EngineUse useEngine(pacini_engine engine)
{
    const Handle handle = Handle::of(engine.id);
    return {all().engines, handle.index, handle.kind == HandleKind::engine ? handle.generation : 0};
}

/// Calls work(engine) for every engine until one fails. Under the lock.
template <typename Work>
pacini_result forEngines(Work&& work)
{
    for (std::uint32_t i = 0; i < mostEngines; ++i)
    {
        const EngineUse use(all().engines, i, all().engines.generationOf(i));
        if (use.get() != nullptr)
            if (const auto result = work(*use.get()->engine); result != PACINI_OK)
                return result;
    }
    return PACINI_OK;
}

/// Lets all engines forget what they made of a clip, before its memory is another's. Under the lock.
void forget(const LoadedClip* clip)
{
    static_cast<void>(forEngines(
        [clip](Engine& engine)
        {
            engine.forget(clip);
            return PACINI_OK;
        }));
}

/// Calls work(engine) for one thread at a time.
template <typename Work>
pacini_result withEngine(pacini_engine engine, Work&& work) noexcept
{
    return guarded(
        [&]
        {
            const std::lock_guard lock(all().control);
            const EngineUse use = useEngine(engine);
            return use.get() != nullptr ? work(*use.get()) : stale("engine");
        });
}

/// Calls work(engine, play) for one thread at a time.
template <typename Work>
pacini_result withPlay(pacini_play play, Work&& work) noexcept
{
    return guarded(
        [&]
        {
            const std::lock_guard lock(all().control);
            if (Handle::of(play.id).kind != HandleKind::play)
                return stale("play");
            const PlayHandle handle = PlayHandle::of(play.id);
            const std::uint32_t generation = all().engines.generationOf(handle.engine);
            if ((generation & 0xFFFu) != handle.engineGeneration)
                return stale("engine of the play");
            const EngineUse use(all().engines, handle.engine, generation);
            if (use.get() == nullptr)
                return stale("engine of the play");
            return work(*use.get()->engine, PlayId{handle.slot, handle.generation});
        });
}

/// Renders an engine for a caller, unless a controller pulls it.
class CallersTurn
{
public:
    explicit CallersTurn(EngineEntry& entryToRender) noexcept : entry(entryToRender)
    {
        entry.rendering.store(true, std::memory_order_seq_cst);
        mine = !entry.pulled.load(std::memory_order_seq_cst);
    }
    ~CallersTurn() { entry.rendering.store(false, std::memory_order_seq_cst); }
    CallersTurn(const CallersTurn&) = delete;
    CallersTurn& operator=(const CallersTurn&) = delete;

    [[nodiscard]] bool isMine() const noexcept { return mine; }

private:
    EngineEntry& entry;
    bool mine;
};

/// What a controller's thread pulls: the engine, as long as there is one.
devices::DriveRenderer pullFrom(pacini_engine engine)
{
    return [engine](std::span<const std::span<float>> out)
    {
        const EngineUse use = useEngine(engine);
        if (use.get() != nullptr)
            return renderTimed(*use.get(), out);
        for (const std::span<float> channel : out)
            std::fill(channel.begin(), channel.end(), 0.0f);
    };
}

/// Gives an engine back to its callers.
void release(pacini_engine engine)
{
    const std::lock_guard lock(all().control);
    const EngineUse use = useEngine(engine);
    if (use.get() != nullptr)
    {
        use.get()->controller = PACINI_NONE;
        use.get()->pulled.store(false, std::memory_order_seq_cst);
    }
}

/// Silences the controller of an engine, which must not wait for the lock.
pacini_result detach(pacini_engine engine)
{
    std::unique_ptr<library::ControllerLink> ending;
    {
        const std::lock_guard lock(all().control);
        const EngineUse use = useEngine(engine);
        if (use.get() == nullptr)
            return stale("engine");
        ending = std::move(use.get()->link);
        if (!ending)
            return fail(PACINI_INVALID, "engine: plays on no controller");
    }
    ending.reset();
    release(engine);
    return PACINI_OK;
}

/// Silences all controllers when the program ends, or the library is unloaded, without having detached them. On Windows
/// threads have been ended by then.
struct StopAtExit
{
    ~StopAtExit()
    {
#if !defined(_WIN32)
        std::vector<std::unique_ptr<library::ControllerLink>> ending;
        const std::lock_guard lock(all().control);
        for (std::uint32_t i = 0; i < mostEngines; ++i)
        {
            const EngineUse use(all().engines, i, all().engines.generationOf(i));
            if (use.get() != nullptr && use.get()->link)
                ending.push_back(std::move(use.get()->link));
        }
        ending.clear(); // their threads need no lock
#endif
    }
};

/// Whether an engine plays on a controller.
bool isTaken(pacini_controller controller)
{
    for (std::uint32_t i = 0; i < mostEngines; ++i)
    {
        const EngineUse use(all().engines, i, all().engines.generationOf(i));
        if (use.get() != nullptr && use.get()->controller == controller)
            return true;
    }
    return false;
}

/// Takes an engine from its callers for a controller. With the lock.
pacini_result reserve(pacini_engine engine, pacini_controller controller)
{
    const EngineUse use = useEngine(engine);
    if (use.get() == nullptr)
        return stale("engine");
    if (use.get()->pulled)
        return fail(PACINI_BUSY, "engine: plays on a controller");
    if (isTaken(controller))
        return fail(PACINI_BUSY, "controller: plays another engine");
    use.get()->pulled.store(true, std::memory_order_seq_cst);
    use.get()->controller = controller;
    return PACINI_OK;
}

/// Opens a controller and starts to play an engine on it, which is reserved.
pacini_result play(pacini_engine engine, const devices::Controller& controller, bool stopOnCrash)
{
    auto opened = devices::OpenController::open(controller.path);
    if (!opened)
        return fail(opened.error(), controller.name);
    const auto model = devices::modelOf(controller, **opened);
    if (!model)
        return fail(model.error(), controller.name);
    const std::lock_guard lock(all().control);
    const EngineUse use = useEngine(engine);
    if (use.get() == nullptr)
        return stale("engine");
    EngineEntry& entry = *use.get();
    if (!devices::DriveRumble::takesRate(entry.sampleRate, *model))
        return fail(PACINI_INVALID, "sample_rate: this controller needs 8000 Hz or more, in whole numbers");
    while (entry.rendering.load(std::memory_order_seq_cst)) // no more than a block
        std::this_thread::yield();
    entry.link = std::make_unique<library::ControllerLink>(
        std::move(*opened), pullFrom(engine),
        library::ControllerLink::Params{*model, entry.actuators, entry.sampleRate, stopOnCrash});
    return PACINI_OK;
}

/// Replaces the list of controllers with those connected now.
void keepConnected(const std::vector<devices::Controller>& now)
{
    std::vector<pacini_controller> kept;
    for (const devices::Controller& controller : now)
    {
        const auto isSame = [&](pacini_controller handle)
        {
            const auto* const known = all().controllers.find(handle.id);
            return known->path == controller.path && known->name == controller.name &&
                   known->haptics == controller.haptics && known->transport == controller.transport;
        };
        auto& before = all().connected;
        const auto found = std::find_if(before.begin(), before.end(), isSame);
        if (found != before.end())
        {
            kept.push_back(*found);
            before.erase(found);
        }
        else if (const std::uint64_t handle = all().controllers.add(controller); handle != 0)
            kept.push_back({handle});
    }
    for (const pacini_controller handle : all().connected)
        all().controllers.remove(handle.id);
    all().connected = std::move(kept);
}

/// Of a text that is too long, whole characters of UTF-8.
void copyText(std::string_view from, std::span<char> to)
{
    std::size_t n = std::min(from.size(), to.size() - 1);
    while (n > 0 && n < from.size() && (static_cast<unsigned char>(from[n]) & 0xC0u) == 0x80u)
        --n;
    std::copy_n(from.begin(), n, to.begin());
    to[n] = '\0';
}

/// Calls work(clip) for one thread at a time.
template <typename Work>
pacini_result withClip(pacini_clip clip, Work&& work) noexcept
{
    return guarded(
        [&]
        {
            const std::lock_guard lock(all().control);
            const auto* const held = all().clips.find(clip.id);
            return held != nullptr ? work(**held) : stale("clip");
        });
}

pacini_result writeMarker(const std::vector<Marker>& markers, std::size_t index, pacini_marker_info* info)
{
    pacini_marker_info read{};
    read.index = static_cast<std::uint32_t>(index);
    read.time = markers[index].time;
    copyText(markers[index].name, read.name);
    return writeStruct(read, info);
}

pacini_result finish(const Result<void>& done)
{
    if (done)
        return PACINI_OK;
    return done.error().where == "play" ? fail(PACINI_STALE, "play: has ended") : fail(done.error());
}

/// Calls work(seconds) for a fade or glide that is in range; `name` is the parameter's.
template <typename Work>
pacini_result within(const char* name, double seconds, Work&& work)
{
    if (!(seconds >= 0.0 && seconds <= 3600.0))
        return fail(PACINI_INVALID, std::string(name) + ": must be 0 to 3600 s");
    return finish(work(Seconds(seconds)));
}

/// Calls work(control, glide) if the control exists and the glide is in range. The engine checks the value, but not
/// that priorities are whole.
template <typename Work>
pacini_result setControl(std::int32_t control, double value, double glide, Work&& work)
{
    if (control < PACINI_GAIN || control > PACINI_TEXTURE_FORCE)
        return fail(PACINI_INVALID, "control: must be a pacini_control");
    if (control == PACINI_PRIORITY && value != std::floor(value))
        return fail(PACINI_INVALID, "priority: must be a whole number");
    return within("glide", glide, [&](Seconds seconds) { return work(static_cast<LiveControl>(control), seconds); });
}

/// Starts a play by start(settings, frame), and gives its handle.
template <typename Start>
pacini_result startPlay(pacini_engine engine, const pacini_play_settings* settings, pacini_play* play, Start&& start)
{
    pacini_play_settings given;
    pacini_play_settings_init(&given);
    if (!readStruct(settings, given))
        return fail(PACINI_INVALID, "settings: call pacini_play_settings_init() first");
    if (std::abs(static_cast<double>(given.priority)) > 1e9)
        return fail(PACINI_INVALID, "priority: must be -1e9 to 1e9");
    PlaySettings wanted;
    wanted.controls = {given.gain, given.intensity, given.pan, given.delay, given.transposition, given.speed};
    wanted.from = given.from;
    wanted.loop = given.loop;
    wanted.passes = given.passes;
    wanted.headroom = given.headroom;
    wanted.fadeIn = Seconds(given.fade_in);
    wanted.group = given.group;
    wanted.priority = given.priority;
    wanted.variation.amount = given.variation;
    wanted.variation.seed = given.seed;
    const Result<PlayId> started = start(std::move(wanted), given.frame);
    if (!started)
        return fail(started.error());
    const Handle owner = Handle::of(engine.id);
    if (play != nullptr)
        *play = {PlayHandle{owner.index, owner.generation, started->slot, started->generation}.number()};
    return PACINI_OK;
}
} // namespace

extern "C"
{
    uint32_t pacini_api_version(void)
    {
        return 1000 * PACINI_API_MAJOR + PACINI_API_MINOR;
    }

    const char* pacini_result_text(pacini_result result)
    {
        switch (result)
        {
        case PACINI_OK:
            return "no error";
        case PACINI_INVALID:
            return "an argument is out of its range";
        case PACINI_STALE:
            return "a handle is not in use (any more)";
        case PACINI_BAD_DATA:
            return "this is not a clip, scene, texture or profile";
        case PACINI_NEWER:
            return "this was written by a newer version";
        case PACINI_TOO_MANY:
            return "there are too many, or it is too large";
        case PACINI_IO:
            return "a file cannot be read";
        case PACINI_NO_MEMORY:
            return "there is not enough memory";
        case PACINI_BUSY:
            return "this plays on a controller";
        case PACINI_INTERNAL:
            break;
        }
        return "a defect of Pacini: please report it";
    }

    size_t pacini_last_error(char* text, size_t size)
    {
        if (text != nullptr && size > 0)
        {
            const std::size_t n = std::min(size - 1, lastError.size());
            std::memcpy(text, lastError.data(), n);
            text[n] = '\0';
        }
        return lastError.size() + 1;
    }

    pacini_result pacini_clip_load(const void* bytes, size_t size, pacini_clip* clip)
    {
        return guarded(
            [&]
            {
                if (clip == nullptr)
                    return fail(PACINI_INVALID, "clip: is NULL");
                if (bytes == nullptr || size == 0)
                    return fail(PACINI_INVALID, "bytes: there are none");
                const auto loaded = loadClip({static_cast<const char*>(bytes), size}, "");
                return loaded ? addClip(*loaded, clip) : fail(loaded.error());
            });
    }

    pacini_result pacini_clip_load_file(const char* path, pacini_clip* clip)
    {
        return guarded(
            [&]
            {
                if (clip == nullptr || path == nullptr)
                    return fail(PACINI_INVALID, clip == nullptr ? "clip: is NULL" : "path: is NULL");
                const auto* const utf8 = reinterpret_cast<const char8_t*>(path);
                auto read = readClip(std::filesystem::path(std::u8string_view(utf8)));
                if (!read)
                    return fail(read.error(), path);
                const auto loaded = read->format == &packedFormat() ? LoadedClip::ofPacked(bytesOf(read->bytes))
                                                                    : LoadedClip::ofClip(read->clip);
                return loaded ? addClip(*loaded, clip) : fail(loaded.error(), path);
            });
    }

    pacini_result pacini_clips_load(const void* const* bytes, const size_t* sizes, size_t count, pacini_clip* clips)
    {
        return guarded(
            [&]
            {
                if (count == 0)
                    return PACINI_OK;
                if (bytes == nullptr || sizes == nullptr || clips == nullptr)
                    return fail(PACINI_INVALID, bytes == nullptr   ? "bytes: is NULL"
                                                : sizes == nullptr ? "sizes: is NULL"
                                                                   : "clips: is NULL");
                if (count > mostClips)
                    return fail(PACINI_TOO_MANY, "count: must be a million at most");
                const auto at = [](const char* what, std::size_t i)
                {
                    return std::string(what) + "[" + std::to_string(i) + "]";
                };
                std::vector<std::shared_ptr<const LoadedClip>> loaded;
                for (std::size_t i = 0; i < count; ++i)
                {
                    if (bytes[i] == nullptr || sizes[i] == 0)
                        return fail(PACINI_INVALID, at("bytes", i) + ": there are none");
                    auto one = loadClip({static_cast<const char*>(bytes[i]), sizes[i]}, "");
                    if (!one)
                        return fail(one.error(), at("bytes", i));
                    loaded.push_back(std::move(one).value());
                }
                std::vector<pacini_clip> added;
                added.reserve(count);
                const std::lock_guard lock(all().control);
                const auto takeBack = [&]
                {
                    for (const pacini_clip one : added)
                        all().clips.remove(one.id);
                };
                try
                {
                    for (auto& one : loaded)
                    {
                        const std::uint64_t handle = all().clips.add(std::move(one));
                        if (handle == 0)
                        {
                            takeBack();
                            return fail(PACINI_TOO_MANY, "a million clips are loaded: release some");
                        }
                        added.push_back({handle});
                    }
                }
                catch (...)
                {
                    takeBack();
                    throw;
                }
                std::copy(added.begin(), added.end(), clips);
                return PACINI_OK;
            });
    }

    pacini_result pacini_clip_reload(pacini_clip clip, const void* bytes, size_t size)
    {
        return guarded(
            [&]
            {
                if (bytes == nullptr || size == 0)
                    return fail(PACINI_INVALID, "bytes: there are none");
                const auto loaded = loadClip({static_cast<const char*>(bytes), size}, "");
                if (!loaded)
                    return fail(loaded.error());
                const std::lock_guard lock(all().control);
                auto* const held = all().clips.find(clip.id);
                if (held == nullptr)
                    return stale("clip");
                // First all that can fail.
                std::vector<std::pair<Engine*, std::vector<Engine::Replacement>>> made;
                const auto done = forEngines(
                    [&](Engine& engine)
                    {
                        auto replacements = engine.makeReplacements(held->get(), *loaded);
                        if (!replacements)
                            return fail(replacements.error());
                        made.emplace_back(&engine, std::move(replacements).value());
                        return PACINI_OK;
                    });
                if (done != PACINI_OK)
                {
                    forget(loaded->get());
                    return done;
                }
                for (auto& [engine, replacements] : made)
                    engine->replaceAll(held->get(), *loaded, std::move(replacements));
                *held = *loaded;
                return PACINI_OK;
            });
    }

    void pacini_clip_info_init(pacini_clip_info* info)
    {
        beginStruct(info);
    }

    pacini_result pacini_clip_get_info(pacini_clip clip, pacini_clip_info* info)
    {
        return withClip(clip,
                        [&](const LoadedClip& loaded)
                        {
                            pacini_clip_info read{};
                            read.events = static_cast<std::uint32_t>(loaded.events());
                            read.duration = loaded.duration();
                            read.bytes = loaded.bytes() + sizeof(LoadedClip) + sizeof(Marker) * loaded.markers().size();
                            for (const Marker& marker : loaded.markers())
                                read.bytes += marker.name.size();
                            copyText(loaded.name(), read.name);
                            return writeStruct(read, info);
                        });
    }

    pacini_result pacini_clip_count_markers(pacini_clip clip, uint32_t* count)
    {
        return withClip(clip,
                        [&](const LoadedClip& loaded)
                        {
                            if (count == nullptr)
                                return fail(PACINI_INVALID, "count: is NULL");
                            *count = static_cast<std::uint32_t>(loaded.markers().size());
                            return PACINI_OK;
                        });
    }

    void pacini_marker_info_init(pacini_marker_info* info)
    {
        beginStruct(info);
    }

    pacini_result pacini_clip_get_marker(pacini_clip clip, uint32_t index, pacini_marker_info* info)
    {
        return withClip(clip,
                        [&](const LoadedClip& loaded)
                        {
                            const auto& markers = loaded.markers();
                            if (index >= markers.size())
                                return fail(PACINI_INVALID,
                                            "index: must be less than the number of markers, which is " +
                                                std::to_string(markers.size()));
                            return writeMarker(markers, index, info);
                        });
    }

    pacini_result pacini_clip_find_marker(pacini_clip clip, const char* name, uint32_t index, pacini_marker_info* info)
    {
        return withClip(clip,
                        [&](const LoadedClip& loaded)
                        {
                            if (name == nullptr)
                                return fail(PACINI_INVALID, "name: is NULL");
                            const auto& markers = loaded.markers();
                            for (std::size_t i = index; i < markers.size(); ++i)
                                if (markers[i].name == name)
                                    return writeMarker(markers, i, info);
                            return fail(PACINI_INVALID, "name: there is no marker '" + std::string(name) +
                                                            (index > 0 ? "' from there on" : "' in the clip"));
                        });
    }

    pacini_result pacini_clip_release(pacini_clip clip)
    {
        return guarded(
            [&]
            {
                const std::lock_guard lock(all().control);
                const auto* const held = all().clips.find(clip.id);
                if (held == nullptr)
                    return stale("clip");
                forget(held->get());
                all().clips.remove(clip.id);
                return PACINI_OK;
            });
    }

    void pacini_engine_config_init(pacini_engine_config* config)
    {
        if (config == nullptr)
            return;
        beginStruct(config);
        const EngineParams usual;
        config->actuator_count = 1;
        config->sample_rate = usual.sampleRate;
        for (pacini_actuator& actuator : config->actuators)
            actuator.gain = 1.0;
        config->pan_law = PACINI_PAN_POWER;
        config->protect = 1;
        config->pan_delay = usual.panDelay.value;
        config->longest_delay = usual.longestDelay.value;
        config->strength = usual.adaptation.strength;
        config->max_plays = static_cast<std::uint32_t>(usual.maxPlays);
        config->max_commands = static_cast<std::uint32_t>(usual.maxCommands);
        config->budget_frames = 512;
    }

    pacini_result pacini_engine_create(const pacini_engine_config* config, pacini_engine* engine)
    {
        return guarded([&] { return createEngine(config, nullptr, engine); });
    }

    pacini_result pacini_engine_create_scene(const pacini_engine_config* config, const char* scene_path,
                                             pacini_engine* engine)
    {
        return guarded(
            [&]
            {
                if (scene_path == nullptr)
                    return fail(PACINI_INVALID, "scene_path: is NULL");
                const auto* const utf8 = reinterpret_cast<const char8_t*>(scene_path);
                const auto scene = readScene(std::filesystem::path(std::u8string_view(utf8)));
                return scene ? createEngine(config, &*scene, engine) : fail(scene.error(), scene_path);
            });
    }

    pacini_result pacini_engine_destroy(pacini_engine engine)
    {
        return guarded(
            [&]
            {
                const Handle handle = Handle::of(engine.id);
                if (handle.kind != HandleKind::engine)
                    return stale("engine");
                static_cast<void>(detach(engine));
                const std::lock_guard lock(all().control);
                const std::unique_ptr<EngineEntry> entry(all().engines.remove(handle.index, handle.generation));
                return entry ? PACINI_OK : stale("engine");
            });
    }

    pacini_result pacini_render(pacini_engine engine, float* const* channels, uint32_t channel_count, uint32_t frames)
    {
        if (channels == nullptr && channel_count > 0)
            return PACINI_INVALID;
        for (std::uint32_t c = 0; c < channel_count; ++c)
            if (channels[c] == nullptr)
                return PACINI_INVALID;
        const EngineUse use = useEngine(engine);
        const std::uint32_t played =
            use.get() == nullptr ? 0
                                 : std::min(channel_count, static_cast<std::uint32_t>(use.get()->engine->actuators()));
        for (std::uint32_t c = played; c < channel_count; ++c)
            std::fill_n(channels[c], frames, 0.0f);
        if (use.get() == nullptr)
            return PACINI_STALE;
        const CallersTurn turn(*use.get());
        if (!turn.isMine())
        {
            for (std::uint32_t c = 0; c < played; ++c)
                std::fill_n(channels[c], frames, 0.0f);
            return PACINI_BUSY;
        }
        std::array<std::span<float>, PACINI_MAX_ACTUATORS> spans;
        for (std::uint32_t c = 0; c < played; ++c)
            spans[c] = std::span(channels[c], frames);
        if (frames > 0)
            renderTimed(*use.get(), std::span(spans).first(played));
        return PACINI_OK;
    }

    pacini_result pacini_render_interleaved(pacini_engine engine, float* samples, uint32_t channel_count,
                                            uint32_t frames)
    {
        if (samples == nullptr && channel_count > 0 && frames > 0)
            return PACINI_INVALID;
        const EngineUse use = useEngine(engine);
        const std::size_t wanted = channel_count;
        std::fill_n(samples, wanted * frames, 0.0f);
        if (use.get() == nullptr)
            return PACINI_STALE;
        EngineEntry& entry = *use.get();
        const CallersTurn turn(entry);
        if (!turn.isMine())
            return PACINI_BUSY;
        const std::size_t played = std::min(wanted, entry.engine->actuators());
        for (std::uint32_t done = 0; done < frames;)
        {
            const std::uint32_t n = std::min(frames - done, blockFrames);
            std::array<std::span<float>, PACINI_MAX_ACTUATORS> spans;
            for (std::size_t c = 0; c < played; ++c)
                spans[c] = std::span(entry.channels[c]).first(n);
            renderTimed(entry, std::span(spans).first(played));
            for (std::uint32_t i = 0; i < n; ++i)
                for (std::size_t c = 0; c < played; ++c)
                    samples[(done + i) * wanted + c] = spans[c][i];
            done += n;
        }
        return PACINI_OK;
    }

    void pacini_engine_info_init(pacini_engine_info* info)
    {
        beginStruct(info);
    }

    pacini_result pacini_engine_get_info(pacini_engine engine, pacini_engine_info* info)
    {
        return withEngine(engine,
                          [&](EngineEntry& entry)
                          {
                              const EngineMeters meters = entry.engine->meters();
                              pacini_engine_info read{};
                              read.latency = static_cast<std::uint32_t>(entry.engine->latencyFrames());
                              read.frame = entry.engine->framesRendered();
                              read.playing = static_cast<std::uint32_t>(meters.playing);
                              read.left_out = static_cast<std::uint32_t>(meters.leftOut);
                              read.cost =
                                  1e-3 * meters.cost * entry.timeFactor * static_cast<double>(entry.budgetFrames);
                              read.left_out_error = meters.leftOutError;
                              read.gain_reduction = meters.gainReduction;
                              return writeStruct(read, info);
                          });
    }

    pacini_result pacini_engine_set_budget(pacini_engine engine, double microseconds, uint32_t frames, uint32_t voices)
    {
        return withEngine(engine,
                          [&](EngineEntry& entry)
                          {
                              if (!(microseconds >= 0.0 && microseconds <= 1e6) || frames < 1)
                                  return fail(PACINI_INVALID,
                                              "budget: must be 0 to 1e6 microseconds for 1 frame or more");
                              return setBudget(entry, microseconds, frames, voices, entry.timeFactor);
                          });
    }

    pacini_result pacini_engine_calibrate(pacini_engine engine, double factor, double* used)
    {
        return withEngine(engine,
                          [&](EngineEntry& entry)
                          {
                              if (factor == 0.0)
                                  factor = measuredFactor(entry);
                              if (!(factor >= leastFactor && factor <= largestFactor))
                                  return fail(PACINI_INVALID, "factor: must be 0.01 to 100, or 0 to measure it of 64 "
                                                              "blocks with plays or more");
                              const pacini_result done =
                                  setBudget(entry, entry.budget, entry.budgetFrames, entry.budgetVoices, factor);
                              if (done == PACINI_OK && used != nullptr)
                                  *used = factor;
                              return done;
                          });
    }

    pacini_result pacini_engine_set_actuator_gain(pacini_engine engine, uint32_t actuator, double gain, double glide,
                                                  int64_t frame)
    {
        return withEngine(engine,
                          [&](EngineEntry& entry) {
                              return within("glide", glide,
                                            [&](Seconds s)
                                            { return entry.engine->setActuatorGain(actuator, gain, s, frame); });
                          });
    }

    void pacini_play_settings_init(pacini_play_settings* settings)
    {
        if (settings == nullptr)
            return;
        beginStruct(settings);
        settings->gain = settings->intensity = settings->speed = 1.0;
        settings->pan = 0.5;
    }

    pacini_result pacini_play_start(pacini_engine engine, pacini_clip clip, const pacini_play_settings* settings,
                                    pacini_play* play)
    {
        return withEngine(engine,
                          [&](EngineEntry& entry)
                          {
                              const auto* const held = all().clips.find(clip.id);
                              if (held == nullptr)
                                  return stale("clip");
                              return startPlay(engine, settings, play,
                                               [&](PlaySettings wanted, int64_t frame)
                                               {
                                                   if (wanted.loop == -1.0)
                                                       wanted.loop = (*held)->duration();
                                                   return entry.engine->play(*held, wanted, frame);
                                               });
                          });
    }

    pacini_result pacini_texture_load(const void* bytes, size_t size, pacini_texture* texture)
    {
        return guarded(
            [&]
            {
                if (texture == nullptr)
                    return fail(PACINI_INVALID, "texture: is NULL");
                if (bytes == nullptr || size == 0)
                    return fail(PACINI_INVALID, "bytes: there are none");
                return addTexture(readTextureJson({static_cast<const char*>(bytes), size}), {}, texture);
            });
    }

    pacini_result pacini_texture_load_file(const char* path, pacini_texture* texture)
    {
        return guarded(
            [&]
            {
                if (texture == nullptr || path == nullptr)
                    return fail(PACINI_INVALID, texture == nullptr ? "texture: is NULL" : "path: is NULL");
                const auto* const utf8 = reinterpret_cast<const char8_t*>(path);
                return addTexture(readTexture(std::filesystem::path(std::u8string_view(utf8))), path, texture);
            });
    }

    pacini_result pacini_texture_release(pacini_texture texture)
    {
        return guarded(
            [&]
            {
                const std::lock_guard lock(all().control);
                if (all().textures.find(texture.id) == nullptr)
                    return stale("texture");
                all().textures.remove(texture.id);
                return PACINI_OK;
            });
    }

    pacini_result pacini_texture_start(pacini_engine engine, pacini_texture texture, double speed, double force,
                                       const pacini_play_settings* settings, pacini_play* play)
    {
        return withEngine(engine,
                          [&](EngineEntry& entry)
                          {
                              const auto* const held = all().textures.find(texture.id);
                              if (held == nullptr)
                                  return stale("texture");
                              return startPlay(engine, settings, play,
                                               [&](PlaySettings wanted, int64_t frame)
                                               {
                                                   wanted.controls.textureSpeed = speed;
                                                   wanted.controls.textureForce = force;
                                                   return entry.engine->play(*held, wanted, frame);
                                               });
                          });
    }

    pacini_result pacini_play_set(pacini_play play, std::int32_t control, double value, double glide, int64_t frame)
    {
        return withPlay(play,
                        [&](Engine& engine, PlayId id)
                        {
                            return setControl(control, value, glide,
                                              [&](LiveControl wanted, Seconds seconds)
                                              { return engine.set(id, wanted, value, seconds, frame); });
                        });
    }

    pacini_result pacini_play_stop(pacini_play play, double fade, int64_t frame)
    {
        return withPlay(play, [&](Engine& engine, PlayId id)
                        { return within("fade", fade, [&](Seconds s) { return engine.stop(id, s, frame); }); });
    }

    pacini_result pacini_play_pause(pacini_play play, double fade, int64_t frame)
    {
        return withPlay(play, [&](Engine& engine, PlayId id)
                        { return within("fade", fade, [&](Seconds s) { return engine.pause(id, s, frame); }); });
    }

    pacini_result pacini_play_resume(pacini_play play, double fade, int64_t frame)
    {
        return withPlay(play, [&](Engine& engine, PlayId id)
                        { return within("fade", fade, [&](Seconds s) { return engine.resume(id, s, frame); }); });
    }

    pacini_result pacini_play_seek(pacini_play play, double position, int64_t frame)
    {
        return withPlay(play, [&](Engine& engine, PlayId id) { return finish(engine.seek(id, position, frame)); });
    }

    void pacini_play_info_init(pacini_play_info* info)
    {
        beginStruct(info);
    }

    pacini_result pacini_play_get_info(pacini_play play, pacini_play_info* info)
    {
        return withPlay(play,
                        [&](Engine& engine, PlayId id)
                        {
                            const PlayStatus status = engine.status(id);
                            pacini_play_info read{};
                            read.state = static_cast<std::int32_t>(status.state);
                            read.position = status.position;
                            return writeStruct(read, info);
                        });
    }

    pacini_result pacini_group_set(pacini_engine engine, uint32_t group, std::int32_t control, double value,
                                   double glide, int64_t frame)
    {
        return withEngine(engine,
                          [&](EngineEntry& entry)
                          {
                              return setControl(control, value, glide,
                                                [&](LiveControl wanted, Seconds seconds) {
                                                    return entry.engine->setGroup(group, wanted, value, seconds, frame);
                                                });
                          });
    }

    pacini_result pacini_group_stop(pacini_engine engine, uint32_t group, double fade, int64_t frame)
    {
        return withEngine(
            engine, [&](EngineEntry& entry)
            { return within("fade", fade, [&](Seconds s) { return entry.engine->stopGroup(group, s, frame); }); });
    }

    pacini_result pacini_controllers_find(pacini_controller* controllers, uint32_t capacity, uint32_t* count)
    {
        return guarded(
            [&]
            {
                if (count == nullptr || (controllers == nullptr && capacity > 0))
                    return fail(PACINI_INVALID, count == nullptr ? "count: is NULL" : "controllers: is NULL");
                const auto now = devices::connectedControllers();
                if (!now)
                    return fail(now.error());
                const std::lock_guard lock(all().control);
                keepConnected(*now);
                const auto& connected = all().connected;
                *count = static_cast<std::uint32_t>(connected.size());
                if (capacity > 0)
                    std::copy_n(connected.begin(), std::min<std::size_t>(capacity, connected.size()), controllers);
                return PACINI_OK;
            });
    }

    void pacini_controller_info_init(pacini_controller_info* info)
    {
        beginStruct(info);
    }

    pacini_result pacini_controller_get_info(pacini_controller controller, pacini_controller_info* info)
    {
        return guarded(
            [&]
            {
                const std::lock_guard lock(all().control);
                const auto* const known = all().controllers.find(controller.id);
                if (known == nullptr)
                    return stale("controller");
                pacini_controller_info read{};
                read.haptics = static_cast<std::int32_t>(known->haptics);
                read.connection = static_cast<std::int32_t>(known->transport);
                copyText(known->name, read.name);
                copyText(known->path, read.path);
                return writeStruct(read, info);
            });
    }

    void pacini_attach_settings_init(pacini_attach_settings* settings)
    {
        beginStruct(settings);
    }

    pacini_result pacini_engine_attach(pacini_engine engine, pacini_controller controller,
                                       const pacini_attach_settings* settings)
    {
        return guarded(
            [&]
            {
                pacini_attach_settings given;
                pacini_attach_settings_init(&given);
                if (!readStruct(settings, given))
                    return fail(PACINI_INVALID, "settings: call pacini_attach_settings_init() first");
                devices::Controller wanted;
                {
                    const std::lock_guard lock(all().control);
                    const auto* const known = all().controllers.find(controller.id);
                    if (known == nullptr)
                        return stale("controller");
                    wanted = *known;
                    if (const auto reserved = reserve(engine, controller); reserved != PACINI_OK)
                        return reserved;
                }
                static const StopAtExit atExit;
                const auto done = play(engine, wanted, given.stop_on_crash != 0);
                if (done != PACINI_OK)
                    release(engine);
                return done;
            });
    }

    pacini_result pacini_engine_detach(pacini_engine engine)
    {
        return guarded([&] { return detach(engine); });
    }

    void pacini_attachment_info_init(pacini_attachment_info* info)
    {
        beginStruct(info);
    }

    pacini_result pacini_engine_get_attachment(pacini_engine engine, pacini_attachment_info* info)
    {
        return withEngine(engine,
                          [&](EngineEntry& entry)
                          {
                              pacini_attachment_info read{};
                              if (entry.link)
                              {
                                  const std::string failure = entry.link->failure();
                                  read.state = failure.empty() ? PACINI_ATTACHED : PACINI_GONE;
                                  read.controller = entry.controller;
                                  read.sent = entry.link->sent();
                                  copyText(failure, read.failure);
                              }
                              return writeStruct(read, info);
                          });
    }
} // extern "C"
