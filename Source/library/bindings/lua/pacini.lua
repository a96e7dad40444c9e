--- Pacini's runtime for LuaJIT and LÖVE: a binding of pacini.h. Needs libpacini (libpacini.so, .dylib or pacini.dll).
--
--     local pacini = require "pacini"
--     local engine = pacini.engine{actuators = {{profile = "lra-175"}}}
--     local play = engine:play(pacini.clip "knock.pacb", {loop = -1})
--     play:set("gain", 0.5, 0.1)
--     local samples = engine:render(256)
--
-- Errors of Pacini are raised, with what pacini_last_error() says. Engines and clips that nothing refers to any more
-- are destroyed and released by the garbage collector, or earlier by destroy() and release().
--
-- SPDX-License-Identifier: MIT
local ffi = require "ffi"

-- What pacini.h 1.5 declares.
ffi.cdef [[
uint32_t pacini_api_version(void);
typedef enum pacini_result {
    PACINI_OK = 0, PACINI_INVALID = 1, PACINI_STALE = 2, PACINI_BAD_DATA = 3, PACINI_NEWER = 4, PACINI_TOO_MANY = 5,
    PACINI_IO = 6, PACINI_NO_MEMORY = 7, PACINI_INTERNAL = 8, PACINI_BUSY = 9
} pacini_result;
const char* pacini_result_text(pacini_result result);
size_t pacini_last_error(char* text, size_t size);
typedef struct pacini_clip { uint64_t id; } pacini_clip;
typedef struct pacini_texture { uint64_t id; } pacini_texture;
typedef struct pacini_engine { uint64_t id; } pacini_engine;
typedef struct pacini_play { uint64_t id; } pacini_play;
typedef struct pacini_controller { uint64_t id; } pacini_controller;

typedef struct pacini_clip_info {
    uint32_t struct_size;
    uint32_t events;
    double duration;
    uint64_t bytes;
    char name[64];
} pacini_clip_info;
pacini_result pacini_texture_load(const void* bytes, size_t size, pacini_texture* texture);
pacini_result pacini_texture_load_file(const char* path, pacini_texture* texture);
pacini_result pacini_texture_release(pacini_texture texture);
pacini_result pacini_clip_load(const void* bytes, size_t size, pacini_clip* clip);
pacini_result pacini_clips_load(const void* const* bytes, const size_t* sizes, size_t count, pacini_clip* clips);
pacini_result pacini_clip_load_file(const char* path, pacini_clip* clip);
pacini_result pacini_clip_reload(pacini_clip clip, const void* bytes, size_t size);
void pacini_clip_info_init(pacini_clip_info* info);
pacini_result pacini_clip_get_info(pacini_clip clip, pacini_clip_info* info);
typedef struct pacini_marker_info {
    uint32_t struct_size;
    uint32_t index;
    double time;
    char name[128];
} pacini_marker_info;
pacini_result pacini_clip_count_markers(pacini_clip clip, uint32_t* count);
void pacini_marker_info_init(pacini_marker_info* info);
pacini_result pacini_clip_get_marker(pacini_clip clip, uint32_t index, pacini_marker_info* info);
pacini_result pacini_clip_find_marker(pacini_clip clip, const char* name, uint32_t index,
    pacini_marker_info* info);
pacini_result pacini_clip_release(pacini_clip clip);

enum { PACINI_MAX_ACTUATORS = 16, PACINI_GROUPS = 32 };
typedef struct pacini_actuator {
    const char* profile;
    double gain;
    double delay;
} pacini_actuator;
typedef struct pacini_engine_config {
    uint32_t struct_size;
    uint32_t actuator_count;
    double sample_rate;
    pacini_actuator actuators[PACINI_MAX_ACTUATORS];
    int32_t pan_law;
    int32_t protect;
    double pan_delay;
    double longest_delay;
    double strength;
    uint32_t max_plays;
    uint32_t max_commands;
    double budget;
    uint32_t budget_frames;
    uint32_t budget_voices;
} pacini_engine_config;
void pacini_engine_config_init(pacini_engine_config* config);
pacini_result pacini_engine_create(const pacini_engine_config* config, pacini_engine* engine);
pacini_result pacini_engine_create_scene(const pacini_engine_config* config, const char* scene_path,
    pacini_engine* engine);
pacini_result pacini_engine_destroy(pacini_engine engine);
pacini_result pacini_render_interleaved(pacini_engine engine, float* samples, uint32_t channel_count,
    uint32_t frames);
typedef struct pacini_engine_info {
    uint32_t struct_size;
    uint32_t latency;
    int64_t frame;
    uint32_t playing;
    uint32_t left_out;
    double cost;
    double left_out_error;
    double gain_reduction;
} pacini_engine_info;
void pacini_engine_info_init(pacini_engine_info* info);
pacini_result pacini_engine_get_info(pacini_engine engine, pacini_engine_info* info);
pacini_result pacini_engine_set_budget(pacini_engine engine, double microseconds, uint32_t frames,
    uint32_t voices);
pacini_result pacini_engine_calibrate(pacini_engine engine, double factor, double* used);
pacini_result pacini_engine_set_actuator_gain(pacini_engine engine, uint32_t actuator, double gain,
    double glide, int64_t frame);

typedef struct pacini_play_settings {
    uint32_t struct_size;
    uint32_t group;
    int64_t frame;
    double gain, intensity, pan, delay, transposition, speed;
    double from;
    double loop;
    uint32_t passes;
    int32_t priority;
    double headroom;
    double fade_in;
    double variation;
    uint64_t seed;
} pacini_play_settings;
void pacini_play_settings_init(pacini_play_settings* settings);
pacini_result pacini_play_start(pacini_engine engine, pacini_clip clip,
    const pacini_play_settings* settings, pacini_play* play);
pacini_result pacini_texture_start(pacini_engine engine, pacini_texture texture, double speed, double force,
    const pacini_play_settings* settings, pacini_play* play);
pacini_result pacini_play_set(pacini_play play, int32_t control, double value, double glide,
    int64_t frame);
pacini_result pacini_play_stop(pacini_play play, double fade, int64_t frame);
pacini_result pacini_play_pause(pacini_play play, double fade, int64_t frame);
pacini_result pacini_play_resume(pacini_play play, double fade, int64_t frame);
pacini_result pacini_play_seek(pacini_play play, double position, int64_t frame);
typedef struct pacini_play_info {
    uint32_t struct_size;
    int32_t state;
    double position;
} pacini_play_info;
void pacini_play_info_init(pacini_play_info* info);
pacini_result pacini_play_get_info(pacini_play play, pacini_play_info* info);
pacini_result pacini_group_set(pacini_engine engine, uint32_t group, int32_t control, double value,
    double glide, int64_t frame);
pacini_result pacini_group_stop(pacini_engine engine, uint32_t group, double fade, int64_t frame);

typedef struct pacini_controller_info {
    uint32_t struct_size;
    int32_t haptics;
    int32_t connection;
    char name[128];
    char path[256];
} pacini_controller_info;
pacini_result pacini_controllers_find(pacini_controller* controllers, uint32_t capacity, uint32_t* count);
void pacini_controller_info_init(pacini_controller_info* info);
pacini_result pacini_controller_get_info(pacini_controller controller, pacini_controller_info* info);
typedef struct pacini_attach_settings {
    uint32_t struct_size;
    int32_t stop_on_crash;
} pacini_attach_settings;
void pacini_attach_settings_init(pacini_attach_settings* settings);
pacini_result pacini_engine_attach(pacini_engine engine, pacini_controller controller,
    const pacini_attach_settings* settings);
pacini_result pacini_engine_detach(pacini_engine engine);
typedef struct pacini_attachment_info {
    uint32_t struct_size;
    int32_t state;
    pacini_controller controller;
    uint64_t sent;
    char failure[128];
} pacini_attachment_info;
void pacini_attachment_info_init(pacini_attachment_info* info);
pacini_result pacini_engine_get_attachment(pacini_engine engine, pacini_attachment_info* info);
]]

local filesystem = love and love.filesystem

--- The library: where PACINI_LIBRARY says, beside the game, or where the system looks for libraries.
local function loadLibrary()
    local file = jit.os == "Windows" and "pacini.dll" or jit.os == "OSX" and "libpacini.dylib" or "libpacini.so"
    local places = {os.getenv "PACINI_LIBRARY"}
    if filesystem then
        places[#places + 1] = filesystem.getSource() .. "/" .. file
        places[#places + 1] = filesystem.getSourceBaseDirectory() .. "/" .. file
    end
    places[#places + 1] = "pacini"
    local reasons = {}
    for _, place in ipairs(places) do
        local found, library = pcall(ffi.load, place)
        if found then return library end
        reasons[#reasons + 1] = tostring(library)
    end
    error("pacini: " .. table.concat(reasons, "\n"), 0)
end

local library = loadLibrary()
local version = library.pacini_api_version()
if version < 1005 or version >= 2000 then
    error("pacini: libpacini has the interface " .. version / 1000 .. ", this file is for 1.5 or a newer 1.x", 0)
end

local controls = {gain = 0, intensity = 1, pan = 2, delay = 3, transposition = 4, speed = 5, priority = 6,
    tones = 7, events = 8, noise = 9, textureSpeed = 10, textureForce = 11}
local panLaws = {power = 0, delay = 1, both = 2}
local states = {[0] = "ended", "waiting", "playing", "paused", "left out"}
local haptics = {[0] = "HD rumble", "DualShock 4", "DualSense", "Xbox", "waveforms", "Steam Controller", "Steam Deck"}
local connections = {[0] = "unknown", "USB", "Bluetooth", "receiver"}
local attachments = {[0] = "detached", "attached", "gone"}
-- Keys of tables to fields of structs.
local configFields = {sampleRate = "sample_rate", panDelay = "pan_delay", longestDelay = "longest_delay",
    strength = "strength", maxPlays = "max_plays", maxCommands = "max_commands", budget = "budget",
    budgetFrames = "budget_frames", budgetVoices = "budget_voices"}
local settingFields = {group = "group", frame = "frame", gain = "gain", intensity = "intensity", pan = "pan",
    delay = "delay", transposition = "transposition", speed = "speed", from = "from", loop = "loop",
    passes = "passes", priority = "priority", headroom = "headroom", fadeIn = "fade_in", variation = "variation",
    seed = "seed"}
local actuatorFields = {gain = "gain", delay = "delay"}

--- Raises what the library says of a call that failed, at the caller of the binding.
local function check(result)
    if result == ffi.C.PACINI_OK then return end
    local size = library.pacini_last_error(nil, 0)
    local text = ffi.new("char[?]", size)
    library.pacini_last_error(text, size)
    -- What C calls max_plays is maxPlays here.
    local said = ffi.string(text):gsub("^%l+_[%l_]+:", function(name)
        return (name:gsub("_(%l)", string.upper))
    end)
    error("pacini: " .. (size > 1 and said or ffi.string(library.pacini_result_text(result))), 3)
end

local function fill(struct, fields, given, what)
    for key, value in pairs(given) do
        local field = fields[key]
        if not field then error("pacini: " .. what .. " has no '" .. tostring(key) .. "'", 3) end
        struct[field] = value
    end
end

local function number(names, given, what)
    local found = names[given]
    if not found then error("pacini: there is no " .. what .. " '" .. tostring(given) .. "'", 3) end
    return found
end

--- A handle which lets go of what it stands for when it is collected.
local function owned(handle, letGo)
    return ffi.gc(handle, function(dying) if dying.id ~= 0 then letGo(dying) end end)
end

local function filled(kind, init)
    local struct = ffi.new(kind)
    init(struct)
    return struct
end

local Clip, Engine, Play = {}, {}, {}
Clip.__index, Engine.__index, Play.__index = Clip, Engine, Play

local pacini = {version = version, Clip = Clip, Engine = Engine, Play = Play}

---- Clips

local function ownedClip(handle)
    return setmetatable({handle = owned(handle, library.pacini_clip_release)}, Clip)
end

--- A clip of any format that Pacini reads from its bytes, a string.
function pacini.clipFromBytes(bytes)
    local out = ffi.new "pacini_clip"
    check(library.pacini_clip_load(bytes, #bytes, out))
    return ownedClip(out)
end

--- Clips of the bytes of several such files, strings: all, or an error about the first that is none.
function pacini.clipsFromBytes(all)
    local bytes, sizes = ffi.new("const void*[?]", #all), ffi.new("size_t[?]", #all)
    for i, one in ipairs(all) do
        bytes[i - 1] = ffi.cast("const char*", one)
        sizes[i - 1] = #one
    end
    local out, clips = ffi.new("pacini_clip[?]", #all), {}
    check(library.pacini_clips_load(bytes, sizes, #all, out))
    for i = 1, #all do
        clips[i] = ownedClip(ffi.new("pacini_clip", out[i - 1])) -- a copy: what is in an array goes with it
    end
    return clips
end

--- The same from a file: of the game in LÖVE, or of the system.
function pacini.clip(path)
    local out = ffi.new "pacini_clip"
    if filesystem and filesystem.getInfo(path, "file") then
        local bytes = assert(filesystem.read(path))
        check(library.pacini_clip_load(bytes, #bytes, out))
    else
        check(library.pacini_clip_load_file(path, out))
    end
    return ownedClip(out)
end

--- A texture from a file, as `pacini texture analyse` makes it: of the game in LÖVE, or of the system.
function pacini.texture(path)
    local out = ffi.new "pacini_texture"
    if filesystem and filesystem.getInfo(path, "file") then
        local bytes = assert(filesystem.read(path))
        check(library.pacini_texture_load(bytes, #bytes, out))
    else
        check(library.pacini_texture_load_file(path, out))
    end
    return {handle = owned(out, library.pacini_texture_release)}
end

--- Puts other content in its place; what plays of it fades over.
function Clip:reload(bytes)
    check(library.pacini_clip_reload(self.handle, bytes, #bytes))
end

--- name, duration (s), events, bytes
function Clip:info()
    local info = filled("pacini_clip_info", library.pacini_clip_info_init)
    check(library.pacini_clip_get_info(self.handle, info))
    return {name = ffi.string(info.name), duration = info.duration, events = info.events, bytes = tonumber(info.bytes)}
end

local function markerOf(info)
    return {index = info.index + 1, time = info.time, name = ffi.string(info.name)}
end

--- Its markers in order of time, each with index (from 1), time (s) and name. A loop of a WAV is two of them, "loop
--- start" and "loop end".
function Clip:markers()
    local count, list = ffi.new "uint32_t[1]", {}
    check(library.pacini_clip_count_markers(self.handle, count))
    local info = filled("pacini_marker_info", library.pacini_marker_info_init)
    for i = 1, count[0] do
        check(library.pacini_clip_get_marker(self.handle, i - 1, info))
        list[i] = markerOf(info)
    end
    return list
end

--- The first marker with this name, from the marker `index` (1) on.
function Clip:findMarker(name, index)
    local info = filled("pacini_marker_info", library.pacini_marker_info_init)
    check(library.pacini_clip_find_marker(self.handle, name, (index or 1) - 1, info))
    return markerOf(info)
end

--- What plays of it goes on to its end.
function Clip:release()
    check(library.pacini_clip_release(self.handle))
    self.handle.id = 0
end

---- Engines

--- An engine. `config` may have sampleRate, actuators (each with profile, gain, delay), panLaw ("power", "delay",
--- "both"), protect (true or false), panDelay, longestDelay, strength, maxPlays, maxCommands, budget, budgetFrames,
--- budgetVoices and scene, the path of a scene file that plays by itself.
function pacini.engine(config)
    local struct = filled("pacini_engine_config", library.pacini_engine_config_init)
    local profiles = {} -- keeps the strings until the engine is there
    local rest = {}
    for key, value in pairs(config or {}) do rest[key] = value end
    for i, actuator in ipairs(rest.actuators or {}) do
        if i > 16 then error("pacini: an engine has 16 actuators at most", 2) end
        local to, others = struct.actuators[i - 1], {}
        for key, value in pairs(actuator) do others[key] = value end
        profiles[i], others.profile = others.profile, nil
        to.profile = profiles[i]
        fill(to, actuatorFields, others, "an actuator")
        struct.actuator_count = i
    end
    if rest.panLaw then struct.pan_law = number(panLaws, rest.panLaw, "pan law") end
    if rest.protect ~= nil then struct.protect = rest.protect and 1 or 0 end
    local scene = rest.scene
    rest.actuators, rest.panLaw, rest.protect, rest.scene = nil, nil, nil, nil
    fill(struct, configFields, rest, "the configuration of an engine")
    local out = ffi.new "pacini_engine"
    if scene then
        check(library.pacini_engine_create_scene(struct, scene, out))
    else
        check(library.pacini_engine_create(struct, out))
    end
    return setmetatable({handle = owned(out, library.pacini_engine_destroy), sampleRate =
        struct.sample_rate, actuators = struct.actuator_count}, Engine)
end

--- Ends it and all its plays.
function Engine:destroy()
    check(library.pacini_engine_destroy(self.handle))
    self.handle.id = 0
end

--- Starts a clip. `settings` may have group, frame, gain, intensity, pan, delay, transposition, speed, from, loop,
--- passes, priority, headroom, fadeIn, variation and seed.
function Engine:play(clip, settings)
    local struct = filled("pacini_play_settings", library.pacini_play_settings_init)
    fill(struct, settingFields, settings or {}, "a play")
    local out = ffi.new "pacini_play"
    check(library.pacini_play_start(self.handle, clip.handle, struct, out))
    return setmetatable({handle = out}, Play)
end

--- Starts a texture, which plays until it is stopped; set "textureSpeed" and "textureForce" (0 to 1) while it does.
function Engine:playTexture(texture, speed, force, settings)
    local struct = filled("pacini_play_settings", library.pacini_play_settings_init)
    fill(struct, settingFields, settings or {}, "a play")
    local out = ffi.new "pacini_play"
    check(library.pacini_texture_start(self.handle, texture.handle, speed or 0, force or 1, struct, out))
    return setmetatable({handle = out}, Play)
end

--- The next frames as a cdata array of floats: frame by frame, `channels` (as many as actuators) in each. The array is
--- the same one each time as long as its size is.
function Engine:render(frames, channels)
    channels = channels or self.actuators
    if frames * channels ~= self.size then
        self.size, self.samples = frames * channels, ffi.new("float[?]", frames * channels)
    end
    local result = library.pacini_render_interleaved(self.handle, self.samples, channels, frames)
    if result ~= ffi.C.PACINI_OK then -- it does not write down why, as it is for audio threads
        error("pacini: engine: " .. ffi.string(library.pacini_result_text(result)), 2)
    end
    return self.samples
end

--- frame, latency, playing, leftOut, cost (microseconds), leftOutError and gainReduction (dB)
function Engine:info()
    local info = filled("pacini_engine_info", library.pacini_engine_info_init)
    check(library.pacini_engine_get_info(self.handle, info))
    return {frame = tonumber(info.frame), latency = info.latency, playing = info.playing, leftOut = info.left_out,
        cost = info.cost, leftOutError = info.left_out_error, gainReduction = info.gain_reduction}
end

--- What may play at a time: microseconds for a block of so many frames, and voices; 0: all.
function Engine:setBudget(microseconds, frames, voices)
    check(library.pacini_engine_set_budget(self.handle, microseconds, frames or 512, voices or 0))
end

--- How many times as long as predicted blocks take on this machine; 0 measures it of the last ones. Returns it.
function Engine:calibrate(factor)
    local used = ffi.new("double[1]")
    check(library.pacini_engine_calibrate(self.handle, factor or 0, used))
    return used[0]
end

--- Gain of an actuator, the first is 1, behind its protection.
function Engine:setActuatorGain(actuator, gain, glide, frame)
    check(library.pacini_engine_set_actuator_gain(self.handle, actuator - 1, gain, glide or 0, frame or 0))
end

--- A control of all plays of a group (0 to 31).
function Engine:setGroup(group, control, value, glide, frame)
    check(library.pacini_group_set(self.handle, group, number(controls, control, "control"), value, glide or 0,
        frame or 0))
end

function Engine:stopGroup(group, fade, frame)
    check(library.pacini_group_stop(self.handle, group, fade or 0, frame or 0))
end

---- Game controllers

--- What is connected: a list of controllers with name, haptics, connection and path.
function pacini.controllers()
    local count, handles = ffi.new "uint32_t[1]", ffi.new "pacini_controller[32]"
    check(library.pacini_controllers_find(handles, 32, count))
    local list = {}
    for i = 0, math.min(32, count[0]) - 1 do
        local info = filled("pacini_controller_info", library.pacini_controller_info_init)
        check(library.pacini_controller_get_info(handles[i], info))
        list[#list + 1] = {handle = ffi.new("pacini_controller", handles[i]), name = ffi.string(info.name), path = ffi.string(info.path),
            haptics = haptics[info.haptics] or "unknown", connection = connections[info.connection] or "unknown"}
    end
    return list
end

--- Plays on one of pacini.controllers() from now on, on a thread of the library; render() is an error meanwhile.
--- `stopOnCrash`: silences it when the program crashes, by handlers of signals.
function Engine:attach(controller, stopOnCrash)
    local settings = filled("pacini_attach_settings", library.pacini_attach_settings_init)
    settings.stop_on_crash = stopOnCrash and 1 or 0
    check(library.pacini_engine_attach(self.handle, controller.handle, settings))
end

function Engine:detach() check(library.pacini_engine_detach(self.handle)) end

--- state ("detached", "attached", "gone"), sent (reports), failure (why it is gone)
function Engine:attachment()
    local info = filled("pacini_attachment_info", library.pacini_attachment_info_init)
    check(library.pacini_engine_get_attachment(self.handle, info))
    return {state = attachments[info.state], sent = tonumber(info.sent), failure = ffi.string(info.failure)}
end

---- Plays

--- A control ("gain", "intensity", "pan", "delay", "transposition", "speed", "priority", "tones", "events",
--- "noise"), in a glide (s), from a frame on.
function Play:set(control, value, glide, frame)
    check(library.pacini_play_set(self.handle, number(controls, control, "control"), value, glide or 0, frame or 0))
end

function Play:stop(fade, frame) check(library.pacini_play_stop(self.handle, fade or 0, frame or 0)) end
function Play:pause(fade, frame) check(library.pacini_play_pause(self.handle, fade or 0, frame or 0)) end
function Play:resume(fade, frame) check(library.pacini_play_resume(self.handle, fade or 0, frame or 0)) end
function Play:seek(position, frame) check(library.pacini_play_seek(self.handle, position, frame or 0)) end

--- state ("ended", "waiting", "playing", "paused", "left out") and position (s of the clip)
function Play:info()
    local info = filled("pacini_play_info", library.pacini_play_info_init)
    check(library.pacini_play_get_info(self.handle, info))
    return {state = states[info.state], position = info.position}
end

---- LÖVE

local Output = {}
Output.__index = Output

--- Plays the engine through a queueable Source of LÖVE, one channel for each actuator; needs love.audio and love.sound.
--- Call update() on it in each love.update(): `buffers` blocks of `frames` frames wait, so much later it is felt.
function Engine:output(options)
    options = options or {}
    local channels = options.channels or self.actuators
    local frames, buffers = options.frames or 512, options.buffers or 6
    local output = setmetatable({engine = self, channels = channels, frames = frames}, Output)
    output.source = love.audio.newQueueableSource(self.sampleRate, 16, channels, buffers)
    output.block = love.sound.newSoundData(frames, self.sampleRate, 16, channels)
    output:update()
    return output
end

--- Renders as many blocks as there is room for.
function Output:update()
    for _ = 1, self.source:getFreeBufferCount() do
        local samples = self.engine:render(self.frames, self.channels)
        local block = ffi.cast("int16_t*", self.block:getFFIPointer())
        for i = 0, self.frames * self.channels - 1 do
            block[i] = math.floor(32767 * math.max(-1, math.min(1, samples[i])) + 0.5)
        end
        self.source:queue(self.block)
    end
    self.source:play() -- it ends by itself when it has had nothing to play
end

return pacini
