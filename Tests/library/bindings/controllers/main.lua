-- Plays short.json on the first controller and prints what happens.
local pacini = require "pacini"

function love.load()
    local controllers = pacini.controllers()
    assert(#controllers == 1)
    local controller = controllers[1]
    print(controller.name, controller.haptics, controller.connection)
    local engine = pacini.engine{actuators = {{}, {}}}
    engine:attach(controller)
    local fine, why = pcall(engine.render, engine, 8)
    assert(not fine and why:find "controller", why)
    local play = engine:play(pacini.clip "short.json")
    while play:info().state ~= "ended" do love.timer.sleep(0.01) end
    local attachment = engine:attachment()
    assert(attachment.sent > 20 and attachment.failure == "")
    print(attachment.state)
    engine:detach()
    print(engine:attachment().state)
    engine:render(8)
    assert(not pcall(engine.detach, engine))
    love.event.quit(0)
end
