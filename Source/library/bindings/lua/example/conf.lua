-- Nothing but what the example needs: no window.
function love.conf(t)
    t.identity = "pacini-example"
    for name in pairs(t.modules) do
        t.modules[name] = name == "audio" or name == "sound" or name == "timer" or name == "event"
    end
end
