# Pacini's runtime for Godot 3: haptic clips that play at once on several actuators.
#
#     var pacini = preload("res://addons/pacini/pacini.gd").new()
#     var engine = pacini.engine({"actuators": [{"profile": "lra-175"}]})
#     var play = engine.play(pacini.clip("res://knock.pacb"), {"loop": -1})
#     play.set_control("gain", 0.5, 0.1)
#     engine.fill(playback) # of an AudioStreamGenerator, in each _process()
#
# What fails says why in the debugger and in `pacini.last_error`, and gives null. Clips and engines that nothing refers to
# any more are released and destroyed.
#
# SPDX-License-Identifier: MIT
extends Reference

const CONTROLS = ["gain", "intensity", "pan", "delay", "transposition", "speed", "priority", "tones", "events",
	"noise", "texture_speed", "texture_force"]
const PAN_LAWS = ["power", "delay", "both"]
const STATES = ["ended", "waiting", "playing", "paused", "left out"]
const HAPTICS = ["HD rumble", "DualShock 4", "DualSense", "Xbox", "waveforms", "Steam Controller", "Steam Deck"]
const CONNECTIONS = ["unknown", "USB", "Bluetooth", "receiver"]
const ATTACHMENTS = ["detached", "attached", "gone"]
const CONFIG = ["scene", "sample_rate", "pan_law", "protect", "pan_delay", "longest_delay", "strength", "max_plays",
	"max_commands", "budget", "budget_frames", "budget_voices"]
const SETTINGS = ["group", "frame", "gain", "intensity", "pan", "delay", "transposition", "speed", "from", "loop", "passes",
	"priority", "headroom", "fade_in", "variation", "seed"]

var _native

func _init():
	_native = Native.new()
	var version = _native.run("version", [])
	if version != null and (version < 1005 or version >= 2000):
		_native.fail("libpacini has the interface %s, this script is for 1.5 or a newer 1.x" % (version / 1000.0))

var last_error setget , _get_last_error

func _get_last_error():
	return _native.last_error

# A clip of any format that Pacini reads, of the game or of the system.
func clip(path):
	var file = File.new()
	if file.open(path, File.READ) != OK:
		return _native.fail("%s: cannot be read" % path)
	return clip_from_bytes(file.get_buffer(file.get_len()))

func clip_from_bytes(bytes):
	var handle = _native.run("clip_load", [bytes])
	return HapticClip.new(_native, handle) if handle != null else null

# What a hand feels of a surface, as `pacini texture analyse` makes it, of the game or of the system.
func texture(path):
	var file = File.new()
	if file.open(path, File.READ) != OK:
		return _native.fail("%s: cannot be read" % path)
	return texture_from_bytes(file.get_buffer(file.get_len()))

func texture_from_bytes(bytes):
	var handle = _native.run("texture_load", [bytes])
	return HapticTexture.new(_native, handle) if handle != null else null

# `config` may have the keys of CONFIG, and actuators: each with profile, gain, delay. A scene is the path of a file of the
# system: ProjectSettings.globalize_path() has it.
func engine(config = {}):
	var given = config.duplicate()
	var actuators = given.get("actuators", [{}])
	given.erase("actuators")
	if given.has("pan_law"):
		given["pan_law"] = _native.number(PAN_LAWS, given["pan_law"])
		if given["pan_law"] == null:
			return null
	var arguments = _native.values(CONFIG, given)
	if arguments == null:
		return null
	for actuator in actuators:
		var profile = actuator.get("profile")
		arguments += [profile if profile != null else "", actuator.get("gain"), actuator.get("delay")]
	var handle = _native.run("engine_create", arguments)
	return HapticEngine.new(_native, handle, actuators.size()) if handle != null else null

# The game controllers, and other haptic devices, that are connected: handle, name, path, haptics, connection of each.
func controllers():
	var found = []
	while true:
		var handle = _native.run("controller", [found.size()])
		if handle == null or handle == 0:
			return found
		found.append({"handle": handle, "name": _native.run("controller_info", [handle, 0]),
			"path": _native.run("controller_info", [handle, 1]), "haptics": HAPTICS[_native.run("controller_info", [handle, 2])],
			"connection": CONNECTIONS[_native.run("controller_info", [handle, 3])]})


class HapticClip:
	var _native
	var _handle

	func _init(native, handle):
		_native = native
		_handle = handle

	func _notification(what):
		if what == NOTIFICATION_PREDELETE and _handle != 0:
			_native.run("clip_release", [_handle])

	# Puts other content in its place; what plays of it fades over.
	func reload(bytes):
		return _native.run("clip_load", [_handle, bytes]) != null

	func get_name():
		return _native.run("clip_info", [_handle, 0])

	func get_duration(): # s
		return _native.run("clip_info", [_handle, 1])

	func get_events():
		return _native.run("clip_info", [_handle, 2])

	# In order of time: index (from 0), time (s) and name of each. A loop of a WAV is two of them, "loop start" and
	# "loop end".
	func get_markers():
		var markers = []
		var count = _native.run("clip_count_markers", [_handle])
		if count == null:
			return null
		for index in count:
			markers.append(_marker(index))
		return markers

	# The first marker with this name, from the marker `index` on.
	func find_marker(name, index = 0):
		var found = _native.run("clip_find_marker", [_handle, name, index])
		return _marker(found) if found != null else null

	func _marker(index):
		return {"index": index, "time": _native.run("clip_marker", [_handle, index, 1]),
			"name": _native.run("clip_marker", [_handle, index, 0])}

	# What plays of it goes on to its end.
	func release():
		var done = _native.run("clip_release", [_handle])
		_handle = 0
		return done != null


class HapticTexture:
	var _native
	var _handle

	func _init(native, handle):
		_native = native
		_handle = handle

	func _notification(what):
		if what == NOTIFICATION_PREDELETE and _handle != 0:
			_native.run("texture_release", [_handle])

	# What plays of it goes on.
	func release():
		var done = _native.run("texture_release", [_handle])
		_handle = 0
		return done != null


class HapticEngine:
	var _native
	var _handle
	var _actuators

	func _init(native, handle, actuators):
		_native = native
		_handle = handle
		_actuators = actuators

	func _notification(what):
		if what == NOTIFICATION_PREDELETE and _handle != 0:
			_native.run("engine_destroy", [_handle])

	# Starts a clip. `settings` may have the keys of SETTINGS.
	func play(clip, settings = {}):
		var arguments = _native.values(SETTINGS, settings)
		if arguments == null:
			return null
		var handle = _native.run("play_start", [_handle, clip._handle] + arguments)
		return HapticPlay.new(_native, handle) if handle != null else null

	# Starts a texture, which plays until it is stopped. Set "texture_speed" and "texture_force" (0 to 1) whenever the hand
	# moves. Of SETTINGS, transposition, speed, from, loop, passes, headroom and variation are without effect.
	func play_texture(texture, speed = 0.0, force = 1.0, settings = {}):
		var arguments = _native.values(SETTINGS, settings)
		if arguments == null:
			return null
		var handle = _native.run("texture_start", [_handle, texture._handle, speed, force] + arguments)
		return HapticPlay.new(_native, handle) if handle != null else null

	# The next frames, frame by frame, all actuators in each.
	func render(frames):
		return _native.run("render", [_handle, frames, _actuators], "the engine is not in use (any more) or plays on a controller")

	# The first two actuators, left and right of a Vector2; a second that is not there is silent.
	func render_stereo(frames):
		return _native.run("render_stereo", [_handle, frames], "the engine is not in use (any more) or plays on a controller")

	# As many frames as there is room for, into an AudioStreamGeneratorPlayback.
	func fill(playback):
		var frames = playback.get_frames_available()
		if frames > 0:
			var samples = render_stereo(frames)
			if samples != null:
				playback.push_buffer(samples)

	func get_info():
		var frame = _native.run("engine_info", [_handle, 0])
		if frame == null:
			return null
		return {"frame": frame, "latency": _native.run("engine_info", [_handle, 1]),
			"playing": _native.run("engine_info", [_handle, 2]), "left_out": _native.run("engine_info", [_handle, 3]),
			"cost": _native.run("engine_info", [_handle, 4]), "left_out_error": _native.run("engine_info", [_handle, 5]),
			"gain_reduction": _native.run("engine_info", [_handle, 6])}

	# What may play at a time: microseconds for a block of so many frames, and voices; 0: all.
	func set_budget(microseconds, frames = 512, voices = 0):
		return _native.run("engine_set_budget", [_handle, microseconds, frames, voices]) != null

	# How many times as long as predicted blocks take on this machine; 0 measures it of the last ones. Returns it, or null.
	func calibrate(factor = 0.0):
		return _native.run("engine_calibrate", [_handle, factor])

	# Gain of an actuator, the first is 0, behind its protection.
	func set_actuator_gain(actuator, gain, glide = 0.0, frame = 0):
		return _native.run("engine_set_actuator_gain", [_handle, actuator, gain, glide, frame]) != null

	# A control of all plays of a group, 0 to 31.
	func set_group(group, control, value, glide = 0.0, frame = 0):
		var number = _native.number(CONTROLS, control)
		return number != null and _native.run("group_set", [_handle, group, number, value, glide, frame]) != null

	func stop_group(group, fade = 0.0, frame = 0):
		return _native.run("group_stop", [_handle, group, fade, frame]) != null

	# Plays on one of controllers() from now on, on a thread of the library; nothing can be rendered meanwhile.
	# `stop_on_crash` silences it when the program crashes, by handlers of signals.
	func attach(controller, stop_on_crash = false):
		return _native.run("engine_attach", [_handle, controller.handle, 1 if stop_on_crash else 0]) != null

	# Silences the controller and gives the engine back to render().
	func detach():
		return _native.run("engine_detach", [_handle]) != null

	# state (one of ATTACHMENTS), sent (reports), failure (why it is gone)
	func get_attachment():
		var state = _native.run("engine_attachment", [_handle, 0])
		if state == null:
			return null
		return {"state": ATTACHMENTS[state], "sent": _native.run("engine_attachment", [_handle, 1]),
			"failure": _native.run("engine_attachment", [_handle, 2])}

	# Ends it and all its plays.
	func destroy():
		var done = _native.run("engine_destroy", [_handle])
		_handle = 0
		return done != null


class HapticPlay:
	var _native
	var _handle

	func _init(native, handle):
		_native = native
		_handle = handle

	# One of CONTROLS, in a glide (s), from a frame on.
	func set_control(control, value, glide = 0.0, frame = 0):
		var number = _native.number(CONTROLS, control)
		return number != null and _native.run("play_set", [_handle, number, value, glide, frame]) != null

	func stop(fade = 0.0, frame = 0):
		return _native.run("play_stop", [_handle, fade, frame]) != null

	func pause(fade = 0.0, frame = 0):
		return _native.run("play_pause", [_handle, fade, frame]) != null

	func resume(fade = 0.0, frame = 0):
		return _native.run("play_resume", [_handle, fade, frame]) != null

	func seek(position, frame = 0):
		return _native.run("play_seek", [_handle, position, frame]) != null

	# One of STATES.
	func get_state():
		var state = _native.run("play_info", [_handle, 0])
		return STATES[state] if state != null else null

	func get_position(): # s of the clip
		return _native.run("play_info", [_handle, 1])


# The functions of pacini_godot.c.
class Native:
	var last_error = ""
	var _library = GDNative.new()
	var _loaded

	func _init():
		_library.library = load("res://addons/pacini/pacini.gdnlib")
		_loaded = _library.initialize()
		if not _loaded:
			fail("libpacini_godot cannot be loaded")

	# Godot keeps what is initialised until it is told, and crashes at its end otherwise; with load_once it would close the
	# library at the first of several. (3.2.3)
	func _notification(what):
		if what == NOTIFICATION_PREDELETE and _loaded:
			_library.terminate()

	func run(name, arguments, silent_error = ""):
		if not _loaded:
			return null
		var result = _library.call_native("standard_varcall", "pacini_godot_" + name, arguments)
		if result == null:
			fail(silent_error if silent_error != "" else _library.call_native("standard_varcall", "pacini_godot_last_error", []))
		return result

	func fail(why):
		last_error = why
		push_error("pacini: " + why)
		return null

	# The values of a dictionary in the order of its keys, null where there is none.
	func values(keys, given):
		var list = []
		for key in given:
			if not keys.has(key):
				return fail("there is no '%s'" % key)
		for key in keys:
			list.append(given.get(key))
		return list

	func number(names, name):
		var at = names.find(name)
		return at if at >= 0 else fail("there is no '%s'" % name)
