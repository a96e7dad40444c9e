-- The first vibration in LÖVE: plays knock.json. Copy pacini.lua and libpacini beside it.
local pacini = require "pacini"
local engine = pacini.engine{actuators = {{profile = "lra-175"}}}
local knock = pacini.clip "knock.json"
engine:play(knock)
local output = engine:output() -- the sound device that the actuator is connected to

function love.update()
    output:update()
end
