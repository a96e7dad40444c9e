# Uses all of pacini.gd in Godot without a window; what must be played like the C program and the command goes into files.
extends SceneTree

const HUM = """{"format": "pacini.clip", "version": 1, "name": "hüm", "duration": 1, "bands": [{"lowFrequency": 90,
 "centreFrequency": 100, "highFrequency": 110, "amplitude": [{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5}]}]}"""

const WOOD = """{"format": "pacini.texture", "version": 1, "pitch": 1, "levelBySpeed": 1, "levelByForce": 0.5,
 "nodes": [{"speed": 0.5, "level": 0.1, "reflection": [-0.6, 0.8]}]}"""

var pacini = load("res://addons/pacini/pacini.gd").new()
var failures = 0

func check(holds, claim):
	if not holds:
		failures += 1
		print("FAILED: ", claim)

func fails(words, result):
	check((result == null or result is bool and not result) and words in pacini.last_error,
		"'%s' and not '%s'" % [words, pacini.last_error])

func largest(samples, channel):
	var most = 0.0
	for i in range(channel, samples.size(), 2):
		most = max(most, abs(samples[i]))
	return most

func write(path, arrays):
	var file = File.new()
	file.open(path, File.WRITE)
	for samples in arrays:
		for sample in samples:
			file.store_float(sample)
	file.close()

func played_like_c():
	var engine = pacini.engine({"actuators": [{"profile": "lra-175"}]})
	engine.play(pacini.clip("res://knock.json"))
	var blocks = []
	for _i in 188:
		blocks.append(engine.render(256))
	write("res://played.raw", blocks)
	engine.destroy()
	engine = pacini.engine({"actuators": [{}, {}], "scene": ProjectSettings.globalize_path("res://two.scene.json")})
	write("res://two.raw", [engine.render(72000)])

func every_function():
	var clip = pacini.clip_from_bytes(HUM.to_utf8())
	check(clip.get_name() == "hüm" and clip.get_duration() == 1.0 and clip.get_events() == 0, "info of the clip")
	var marked = pacini.clip_from_bytes(HUM.replace("\"duration\": 1,", """"duration": 1, "markers": [
		{"time": 0.25, "name": "schön"}, {"time": 0.5, "name": "step"}, {"time": 0.75, "name": "step"}],""").to_utf8())
	var markers = marked.get_markers()
	check(markers.size() == 3 and markers[0].name == "schön" and abs(markers[2].time - 0.75) < 0.001, "markers")
	check(marked.find_marker("step").index == 1 and marked.find_marker("step", 2).index == 2, "a marker by its name")
	fails("no marker 'schön'", marked.find_marker("schön", 1))
	check(clip.get_markers() == [], "no markers")
	var engine = pacini.engine({"sample_rate": 8000, "actuators": [{}, {"gain": 0.5}], "max_plays": 8, "pan_law": "power",
		"protect": true})
	var play = engine.play(clip, {"loop": -1, "pan": 0, "frame": 1000})
	check(play.get_state() == "waiting", "waits")
	check(largest(engine.render(1000), 0) == 0.0, "silent before its frame")
	check(largest(engine.render(1000), 0) > 0.4, "sounds")
	check(play.get_state() == "playing" and abs(play.get_position() - 0.125) < 0.01, "position")
	check(play.set_control("pan", 1), "pan")
	engine.render(1000)
	var samples = engine.render(1000)
	check(largest(samples, 0) == 0.0 and largest(samples, 1) > 0.2 and largest(samples, 1) < 0.26, "to the right")
	check(engine.set_actuator_gain(1, 0.0), "gain of the actuator")
	engine.render(1000)
	check(largest(engine.render(1000), 1) == 0.0, "the gain of the actuator is 0")
	engine.set_actuator_gain(1, 1.0)
	check(clip.reload(HUM.replace("0.5", "0.1").to_utf8()), "reload")
	engine.render(1000)
	var faint = largest(engine.render(1000), 1)
	check(faint > 0.05 and faint < 0.15, "the other content plays")
	check(play.set_control("noise", 0.5) and play.set_control("events", 0.5), "roles")
	check(engine.set_group(0, "tones", 0.0), "group") # all that is in this clip
	engine.render(1000)
	check(largest(engine.render(1000), 1) == 0.0, "the fader is down")
	check(play.seek(0.5) and play.pause(0.01), "seek and pause")
	engine.render(1000)
	check(play.get_state() == "paused", "paused")
	check(play.resume(0.01), "resume")
	var pairs = engine.render_stereo(1000)
	check(pairs.size() == 1000 and pairs[500] is Vector2, "pairs")
	check(play.get_state() == "playing", "resumed")
	var info = engine.get_info()
	check(info.playing == 1 and info.frame == 12000 and info.latency == 8 and info.left_out_error == -1000, "info of the engine")
	check(engine.set_budget(0, 512, 1), "budget")
	check(engine.calibrate(2.5) == 2.5, "calibrate")
	var second = engine.play(clip, {"priority": 5})
	engine.render(100)
	check(second.get_state() == "left out", "left out")
	check(play.stop(0.01) and engine.stop_group(0), "stop")
	engine.render(1000)
	check(play.get_state() == "ended", "ended")

	fails("play: has ended", play.set_control("gain", 1))
	fails("there is no 'volume'", play.set_control("volume", 1))
	fails("there is no 'lop'", engine.play(clip, {"lop": 1}))
	fails("loop", engine.play(clip, {"loop": 5}))
	for group in [-1, 32, 1 << 32]: # not those that it becomes in 32 bits
		fails("group: must be 0 to 31", engine.play(clip, {"group": group}))
	fails("fade: must be 0 to 3600 s", engine.stop_group(0, -1))
	fails("'lra-176' is no profile", pacini.engine({"actuators": [{"profile": "lra-176"}]}))
	var many = []
	many.resize(17)
	for i in 17:
		many[i] = {}
	fails("actuator_count", pacini.engine({"actuators": many}))
	fails("none.pacb: cannot be read", pacini.clip("res://none.pacb"))
	fails("is not a clip", pacini.clip_from_bytes("nonsense".to_utf8()))
	check(clip.release(), "release")
	fails("clip is not in use", clip.release())
	fails("clip is not in use", engine.play(clip))
	check(engine.destroy(), "destroy")
	fails("engine is not in use", engine.render(8))
	fails("engine is not in use", engine.stop_group(0))
	fails("engine of the play", play.stop())

func textures():
	var texture = pacini.texture_from_bytes(WOOD.to_utf8())
	var engine = pacini.engine({"sample_rate": 8000, "actuators": [{}, {}], "protect": false})
	var play = engine.play_texture(texture, 0.0, 1.0, {"pan": 0})
	check(largest(engine.render(2000), 0) == 0.0, "a hand that rests feels nothing")
	check(play.set_control("texture_speed", 0.5), "speed")
	engine.render(1000)
	var samples = engine.render(4000)
	check(largest(samples, 0) > 0.1 and largest(samples, 0) < 1.0 and largest(samples, 1) == 0.0, "a hand that moves")
	check(play.set_control("texture_force", 0.0), "force")
	engine.render(1000)
	check(largest(engine.render(1000), 0) == 0.0, "a hand that is lifted")
	check(texture.release() and play.set_control("texture_force", 1.0), "what plays of it goes on")
	engine.render(1000)
	check(largest(engine.render(4000), 0) > 0.1, "goes on")
	check(play.stop(0.01), "stop")
	engine.render(1000)
	check(play.get_state() == "ended", "ended")

	fails("there is no 'lop'", engine.play_texture(texture, 0.0, 1.0, {"lop": 1}))
	fails("texture is not in use", engine.play_texture(texture))
	fails("texture is not in use", texture.release())
	fails("texture_speed: must be 0 to 1", engine.play_texture(pacini.texture_from_bytes(WOOD.to_utf8()), 2.0))
	fails("none.json: cannot be read", pacini.texture("res://none.json"))
	fails("format: must be", pacini.texture_from_bytes(HUM.to_utf8()))
	fails("is not valid JSON", pacini.texture_from_bytes("nonsense".to_utf8()))
	var motor = pacini.engine({"actuators": [{"profile": "erm-coin"}]})
	fails("motor", motor.play_texture(pacini.texture_from_bytes(WOOD.to_utf8())))

func what_nothing_refers_to_is_destroyed():
	for _i in 200: # 64 at a time
		check(pacini.engine({"sample_rate": 8000, "max_plays": 4}) != null, "an engine")

func _init():
	played_like_c()
	every_function()
	textures()
	what_nothing_refers_to_is_destroyed()
	var example = load("res://first_vibration.gd").new()
	get_root().add_child(example)
	for _i in 20:
		yield(self, "idle_frame")
	check(example.engine.get_info().frame > 1000, "the example has filled the generator")
	example.free()
	print("failures: ", failures)
	quit(1 if failures > 0 else 0)
