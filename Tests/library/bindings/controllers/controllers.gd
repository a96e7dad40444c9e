# Plays short.json on the first controller and prints what happens.
extends SceneTree

func _init():
	var pacini = load("res://addons/pacini/pacini.gd").new()
	var controllers = pacini.controllers()
	var holds = controllers.size() == 1
	print(controllers[0].name, " ", controllers[0].haptics, " ", controllers[0].connection)
	var engine = pacini.engine({"actuators": [{}, {}]})
	holds = holds and engine.attach(controllers[0]) and engine.render(8) == null
	var play = engine.play(pacini.clip("res://short.json"))
	while play.get_state() != "ended":
		OS.delay_msec(10)
	var attachment = engine.get_attachment()
	holds = holds and attachment.sent > 20 and attachment.failure == ""
	print(attachment.state)
	holds = holds and engine.detach()
	print(engine.get_attachment().state)
	holds = holds and engine.render(8) != null and not engine.detach()
	quit(0 if holds else 1)
