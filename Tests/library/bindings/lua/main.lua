-- Uses all of pacini.lua in LÖVE without a window, and writes the knock as floats into played.raw of its folder.
local pacini = require "pacini"
local ffi = require "ffi"

local function equal(a, b, what)
    if a ~= b then error((what or "") .. ": " .. tostring(a) .. " instead of " .. tostring(b), 2) end
end

local function fails(text, work, ...)
    local fine, why = pcall(work, ...)
    if fine or not tostring(why):find(text, 1, true) then
        error("does not fail with '" .. text .. "' but: " .. tostring(why), 2)
    end
end

local function largest(samples, n)
    local most = 0
    for i = 0, n - 1 do most = math.max(most, math.abs(samples[i])) end
    return most
end

local function playedLikeC()
    local engine = pacini.engine{actuators = {{profile = "lra-175"}}}
    engine:play(pacini.clip "knock.json")
    local file = assert(io.open(os.getenv "HOME" .. "/played.raw", "wb"))
    for _ = 1, 188 do file:write(ffi.string(engine:render(256), 4 * 256)) end
    file:close()
    engine:destroy()
end

local hum = [[{"format": "pacini.clip", "version": 1, "name": "hum", "duration": 1, "bands": [{"lowFrequency": 90,
 "centreFrequency": 100, "highFrequency": 110, "amplitude": [{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5}]}]}]]

local function everyFunction()
    local clip = pacini.clipFromBytes(hum)
    equal(clip:info().name, "hum")
    equal(clip:info().duration, 1)
    local two = pacini.clipsFromBytes{hum, hum}
    equal(#two, 2)
    equal(two[2]:info().name, "hum")
    fails("bytes[1]: ", pacini.clipsFromBytes, {hum, "none"})
    fails("maxPlays: must be", pacini.engine, {maxPlays = 1000000})
    local marked = pacini.clipFromBytes((hum:gsub('"duration": 1,', [["duration": 1, "markers": [
        {"time": 0.25, "name": "schön"}, {"time": 0.5, "name": "step"}, {"time": 0.75, "name": "step"}],]])))
    equal(#marked:markers(), 3)
    equal(marked:markers()[1].name, "schön")
    equal(marked:findMarker("step").index, 2)
    assert(math.abs(marked:findMarker("step", 3).time - 0.75) < 1e-3)
    fails("no marker 'schön'", marked.findMarker, marked, "schön", 2)
    equal(#clip:markers(), 0)
    local engine = pacini.engine{sampleRate = 8000, actuators = {{}, {gain = 0.5}}, panLaw = "power", maxPlays = 8,
        protect = true}
    local play = engine:play(clip, {loop = -1, pan = 0, frame = 1000})
    equal(play:info().state, "waiting")
    equal(largest(engine:render(1000), 2000), 0)
    assert(largest(engine:render(1000), 2000) > 0.4)
    equal(play:info().state, "playing")
    play:set("pan", 1)
    engine:render(1000)
    local samples = engine:render(1000)
    for i = 0, 999 do
        equal(samples[2 * i], 0)
        assert(math.abs(samples[2 * i + 1]) < 0.26)
    end
    engine:setActuatorGain(2, 0)
    engine:render(1000)
    equal(largest(engine:render(1000), 2000), 0)
    engine:setActuatorGain(2, 1)
    clip:reload((hum:gsub("0.5", "0.1")))
    engine:render(1000)
    assert(largest(engine:render(1000), 2000) < 0.15)
    play:set("noise", 0.5)
    play:set("events", 0.5)
    engine:setGroup(0, "tones", 0) -- all that is in this clip
    engine:render(1000)
    equal(largest(engine:render(1000), 2000), 0)
    play:seek(0.5)
    play:pause(0.01)
    engine:render(1000)
    equal(play:info().state, "paused")
    play:resume(0.01)
    engine:render(1000)
    equal(play:info().state, "playing")
    equal(engine:info().playing, 1)
    equal(engine:info().frame, 12000)
    engine:setBudget(0, 512, 1)
    assert(engine:calibrate(2.5) == 2.5)
    engine:play(clip, {priority = 5})
    engine:render(100)
    equal(engine:info().leftOut, 1)
    play:stop(0.01)
    engine:stopGroup(0)
    engine:render(1000)
    equal(play:info().state, "ended")

    fails("play: has ended", play.set, play, "gain", 1)
    fails("there is no control 'volume'", play.set, play, "volume", 1)
    fails("a play has no 'lop'", engine.play, engine, clip, {lop = 1})
    fails("loop", engine.play, engine, clip, {loop = 5})
    fails("cannot convert 'struct pacini_engine' to 'struct pacini_clip'", engine.play, engine, engine)
    fails("'lra-176' is no profile", pacini.engine, {actuators = {{profile = "lra-176"}}})
    fails("there/is/none", pacini.clip, "there/is/none")
    fails("is not a clip", pacini.clipFromBytes, "nonsense")
    clip:release()
    fails("clip is not in use", clip.release, clip)
    fails("clip is not in use", engine.play, engine, clip)
    engine:destroy()
    fails("engine: a handle is not in use", engine.render, engine, 8)
    fails("engine is not in use", engine.stopGroup, engine, 0)
    fails("engine of the play is not in use", play.stop, play)
end

local function garbageIsReleased() -- an engine too many would fail
    for _ = 1, 200 do
        pacini.engine{sampleRate = 8000, maxPlays = 4}
        collectgarbage()
    end
end

function love.load()
    playedLikeC()
    everyFunction()
    garbageIsReleased()
    love.event.quit(0)
end
