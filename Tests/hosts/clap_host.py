"""A host for CLAP plugins in Python, for tests: it declares the interface once more, by its own reading of CLAP 1.2,
and keeps a record of what the plugin asks of it."""

import ctypes as c
import time

import numpy as np

NAME, PATH = 256, 1024
VALUE, MODULATION, BEGIN, END = 5, 6, 7, 8
STEPPED, BYPASS, AUTOMATABLE, MODULATABLE, ENUM = 1, 16, 32, 1024, 1 << 16
INVALID = 0xFFFFFFFF
ERROR, CONTINUE = 0, 1


def structure(name, *fields):
    return type(name, (c.Structure,), {"_fields_": list(fields)})


def function(result, *arguments):
    return c.CFUNCTYPE(result, *arguments)


void, text, u32, i32, f64, yes = c.c_void_p, c.c_char_p, c.c_uint32, c.c_int32, c.c_double, c.c_bool
Version = structure("Version", ("major", u32), ("minor", u32), ("revision", u32))
HostStruct = structure(
    "HostStruct",
    ("version", Version),
    ("data", void),
    ("name", text),
    ("vendor", text),
    ("url", text),
    ("own_version", text),
    ("get_extension", function(void, void, text)),
    ("request_restart", function(None, void)),
    ("request_process", function(None, void)),
    ("request_callback", function(None, void)),
)
Header = structure("Header", ("size", u32), ("time", u32), ("space", c.c_uint16), ("type", c.c_uint16), ("flags", u32))
ValueEvent = structure(
    "ValueEvent",
    ("header", Header),
    ("id", u32),
    ("cookie", void),
    ("note", i32),
    ("port", c.c_int16),
    ("channel", c.c_int16),
    ("key", c.c_int16),
    ("value", f64),
)
GestureEvent = structure("GestureEvent", ("header", Header), ("id", u32))
InEvents = structure("InEvents", ("ctx", void), ("size", function(u32, void)), ("get", function(void, void, u32)))
OutEvents = structure("OutEvents", ("ctx", void), ("try_push", function(yes, void, c.POINTER(Header))))
Buffer = structure(
    "Buffer",
    ("data32", c.POINTER(void)),
    ("data64", c.POINTER(void)),
    ("channels", u32),
    ("latency", u32),
    ("constant", c.c_uint64),
)
Process = structure(
    "Process",
    ("steady", c.c_int64),
    ("frames", u32),
    ("transport", void),
    ("inputs", c.POINTER(Buffer)),
    ("outputs", c.POINTER(Buffer)),
    ("input_count", u32),
    ("output_count", u32),
    ("in_events", c.POINTER(InEvents)),
    ("out_events", c.POINTER(OutEvents)),
)
Descriptor = structure(
    "Descriptor",
    ("version", Version),
    ("id", text),
    ("name", text),
    ("vendor", text),
    ("url", text),
    ("manual", text),
    ("support", text),
    ("own_version", text),
    ("description", text),
    ("features", c.POINTER(text)),
)
PluginStruct = structure(
    "PluginStruct",
    ("descriptor", c.POINTER(Descriptor)),
    ("data", void),
    ("init", function(yes, void)),
    ("destroy", function(None, void)),
    ("activate", function(yes, void, f64, u32, u32)),
    ("deactivate", function(None, void)),
    ("start_processing", function(yes, void)),
    ("stop_processing", function(None, void)),
    ("reset", function(None, void)),
    ("process", function(i32, void, c.POINTER(Process))),
    ("get_extension", function(void, void, text)),
    ("on_main_thread", function(None, void)),
)
Factory = structure(
    "Factory",
    ("count", function(u32, void)),
    ("descriptor", function(c.POINTER(Descriptor), void, u32)),
    ("create", function(c.POINTER(PluginStruct), void, c.POINTER(HostStruct), text)),
)
Entry = structure(
    "Entry",
    ("version", Version),
    ("init", function(yes, text)),
    ("deinit", function(None)),
    ("get_factory", function(c.POINTER(Factory), text)),
)
Port = structure(
    "Port",
    ("id", u32),
    ("name", c.c_char * NAME),
    ("flags", u32),
    ("channels", u32),
    ("type", text),
    ("in_place", u32),
)
AudioPorts = structure(
    "AudioPorts", ("count", function(u32, void, yes)), ("get", function(yes, void, u32, yes, c.POINTER(Port)))
)
Request = structure("Request", ("is_input", yes), ("port", u32), ("channels", u32), ("type", text), ("details", void))
ConfigurablePorts = structure(
    "ConfigurablePorts",
    ("can_apply", function(yes, void, c.POINTER(Request), u32)),
    ("apply", function(yes, void, c.POINTER(Request), u32)),
)
PortsConfig = structure(
    "PortsConfig",
    ("id", u32),
    ("name", c.c_char * NAME),
    ("inputs", u32),
    ("outputs", u32),
    ("has_input", yes),
    ("input_channels", u32),
    ("input_type", text),
    ("has_output", yes),
    ("output_channels", u32),
    ("output_type", text),
)
PortsConfigs = structure(
    "PortsConfigs",
    ("count", function(u32, void)),
    ("get", function(yes, void, u32, c.POINTER(PortsConfig))),
    ("select", function(yes, void, u32)),
)
Info = structure(
    "Info",
    ("id", u32),
    ("flags", u32),
    ("cookie", void),
    ("name", c.c_char * NAME),
    ("module", c.c_char * PATH),
    ("low", f64),
    ("high", f64),
    ("standard", f64),
)
Parameters = structure(
    "Parameters",
    ("count", function(u32, void)),
    ("get_info", function(yes, void, u32, c.POINTER(Info))),
    ("get_value", function(yes, void, u32, c.POINTER(f64))),
    ("value_to_text", function(yes, void, u32, f64, void, u32)),
    ("text_to_value", function(yes, void, u32, text, c.POINTER(f64))),
    ("flush", function(None, void, c.POINTER(InEvents), c.POINTER(OutEvents))),
)
Stream = structure("Stream", ("ctx", void), ("move", function(c.c_int64, void, void, c.c_uint64)))
State = structure(
    "State", ("save", function(yes, void, c.POINTER(Stream))), ("load", function(yes, void, c.POINTER(Stream)))
)
Number = structure("Number", ("get", function(u32, void)))
Render = structure("Render", ("hard", function(yes, void)), ("set", function(yes, void, i32)))
Timer = structure("Timer", ("on_timer", function(None, void, u32)))
Window = structure("Window", ("api", text), ("x11", c.c_ulong))
Hints = structure(
    "Hints", ("across", yes), ("along", yes), ("ratio", yes), ("ratio_width", u32), ("ratio_height", u32)
)
Gui = structure(
    "Gui",
    ("is_api_supported", function(yes, void, text, yes)),
    ("get_preferred_api", function(yes, void, c.POINTER(text), c.POINTER(yes))),
    ("create", function(yes, void, text, yes)),
    ("destroy", function(None, void)),
    ("set_scale", function(yes, void, f64)),
    ("get_size", function(yes, void, c.POINTER(u32), c.POINTER(u32))),
    ("can_resize", function(yes, void)),
    ("get_resize_hints", function(yes, void, c.POINTER(Hints))),
    ("adjust_size", function(yes, void, c.POINTER(u32), c.POINTER(u32))),
    ("set_size", function(yes, void, u32, u32)),
    ("set_parent", function(yes, void, c.POINTER(Window))),
    ("set_transient", function(yes, void, c.POINTER(Window))),
    ("suggest_title", function(None, void, text)),
    ("show", function(yes, void)),
    ("hide", function(yes, void)),
)
HostParameters = structure(
    "HostParameters",
    ("rescan", function(None, void, u32)),
    ("clear", function(None, void, u32, u32)),
    ("request_flush", function(None, void)),
)
HostCall = structure("HostCall", ("call", function(None, void)))
HostTimer = structure(
    "HostTimer", ("register", function(yes, void, u32, c.POINTER(u32))), ("unregister", function(yes, void, u32))
)
HostGui = structure(
    "HostGui",
    ("hints_changed", function(None, void)),
    ("request_resize", function(yes, void, u32, u32)),
    ("request_show", function(yes, void)),
    ("request_hide", function(yes, void)),
    ("closed", function(None, void, yes)),
)

EXTENSIONS = {
    b"clap.audio-ports": AudioPorts,
    b"clap.configurable-audio-ports/1": ConfigurablePorts,
    b"clap.audio-ports-config": PortsConfigs,
    b"clap.params": Parameters,
    b"clap.state": State,
    b"clap.latency": Number,
    b"clap.tail": Number,
    b"clap.render": Render,
    b"clap.timer-support": Timer,
    b"clap.gui": Gui,
}


class Library:
    """A .clap file."""

    def __init__(self, path):
        self.path = str(path).encode()
        self.entry = Entry.in_dll(c.CDLL(str(path)), "clap_entry")
        if not self.entry.init(self.path):
            raise OSError("the plugin cannot be entered")
        self.factory = self.entry.get_factory(b"clap.plugin-factory").contents

    def descriptor(self, index=0):
        found = self.factory.descriptor(c.addressof(self.factory), index)
        return found.contents if found else None


def value_event(identifier, value, at=0, kind=VALUE, **header):
    event = ValueEvent(Header(c.sizeof(ValueEvent), at, 0, kind, 0), identifier, None, -1, -1, -1, -1, value)
    for name, wanted in header.items():
        setattr(event.header, name, wanted)
    return event


class Events:
    """A list of events for the plugin, and one of what it sends."""

    def __init__(self, events=()):
        self.events = list(events)
        self.sent = []
        self.accepts = True
        self.input = InEvents(
            None,
            InEvents._fields_[1][1](lambda _: len(self.events)),
            InEvents._fields_[2][1](lambda _, i: c.addressof(self.events[i]) if self.events[i] else None),
        )
        self.output = OutEvents(None, OutEvents._fields_[1][1](self.push))

    def push(self, _, header):
        if not self.accepts:
            return False
        kind = header.contents.type
        event = c.cast(header, c.POINTER(ValueEvent if kind == VALUE else GestureEvent)).contents
        self.sent.append((kind, event.id, event.value if kind == VALUE else None, header.contents.time))
        return True


class Plugin:
    """An instance. `timers`: whether the host has timers; run() is its main loop."""

    def __init__(self, library, timers=True):
        self.timers, self.next_timer, self.record = {}, 7, []
        self.accepts_resize = True
        self.callbacks = []  # kept alive
        self.host_extensions = {
            b"clap.params": self.keep(
                HostParameters,
                lambda _, flags: self.note("rescan", flags),
                lambda *_: self.note("clear"),
                lambda _: self.note("flush"),
            ),
            b"clap.latency": self.keep(HostCall, lambda _: self.note("latency")),
            b"clap.state": self.keep(HostCall, lambda _: self.note("dirty")),
            b"clap.gui": self.keep(
                HostGui,
                lambda _: self.note("hints"),
                self.resize,
                lambda _: True,
                lambda _: True,
                lambda *_: self.note("closed"),
            ),
        }
        if timers:
            self.host_extensions[b"clap.timer-support"] = self.keep(HostTimer, self.register, self.unregister)
        self.host = self.keep(
            HostStruct,
            Version(1, 2, 2),
            None,
            b"Pacini's tests",
            b"Pacini",
            b"",
            b"1",
            lambda _, name: c.addressof(self.host_extensions[name]) if name in self.host_extensions else None,
            lambda _: self.note("restart"),
            lambda _: self.note("process"),
            lambda _: self.note("callback"),
        )
        factory = library.factory
        made = factory.create(c.addressof(factory), c.byref(self.host), library.descriptor().id)
        if not made:
            raise OSError("no instance")
        self.struct, self.at = made.contents, c.addressof(made.contents)
        if not self.struct.init(self.at):
            raise OSError("the instance cannot be initialised")
        self.extensions = {}
        for name, kind in EXTENSIONS.items():
            found = self.struct.get_extension(self.at, name)
            if found:
                self.extensions[name.decode()] = kind.from_address(found)
        self.parameters = {}
        for index in range(self.call("params", "count")):
            info = Info()
            self.call("params", "get_info", index, c.byref(info))
            self.parameters[info.name.decode()] = info

    def keep(self, kind, *values):
        made = []
        for (_, wanted), value in zip(kind._fields_, values):
            made.append(wanted(value) if callable(value) and not isinstance(value, c.Structure) else value)
        self.callbacks.append(made)
        return kind(*made)

    def note(self, what, *more):
        self.record.append((what, *more))

    def resize(self, _, width, height):
        self.note("resize", width, height)
        return self.accepts_resize

    def register(self, _, period, identifier):
        self.next_timer += 1
        self.timers[self.next_timer] = period
        identifier[0] = self.next_timer
        return True

    def unregister(self, _, identifier):
        return self.timers.pop(identifier, None) is not None

    def run(self, seconds=0.1):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for identifier in list(self.timers):
                self.call("timer-support", "on_timer", identifier)
            if ("callback",) in self.record:
                self.record.remove(("callback",))
                self.struct.on_main_thread(self.at)
            time.sleep(0.005)

    def call(self, extension, name, *arguments):
        full = f"clap.{extension}"
        return getattr(self.extensions[full], name)(self.at, *arguments)

    def activate(self, rate=48000.0, frames=8192):
        return self.struct.activate(self.at, rate, 1, frames) and self.struct.start_processing(self.at)

    def deactivate(self):
        self.struct.stop_processing(self.at)
        self.struct.deactivate(self.at)

    def reset(self):
        self.struct.reset(self.at)

    def destroy(self):
        self.struct.destroy(self.at)

    def ports(self, is_input):
        found = []
        for index in range(self.call("audio-ports", "count", is_input)):
            port = Port()
            self.call("audio-ports", "get", index, is_input, c.byref(port))
            found.append(port)
        return found

    def value(self, name):
        value = f64()
        known = self.call("params", "get_value", self.parameters[name].id, c.byref(value))
        return value.value if known else None

    def text(self, name, value, capacity=NAME):
        buffer = c.create_string_buffer(b"\x55" * (capacity + 8), capacity + 8)
        if not self.call("params", "value_to_text", self.parameters[name].id, value, buffer, capacity):
            return None
        if buffer.raw[capacity:] != b"\x55" * 8:
            raise MemoryError("the plugin wrote behind the end")
        return buffer.value.decode()

    def typed(self, name, words):
        value = f64(-12345.0)
        known = self.call("params", "text_to_value", self.parameters[name].id, words.encode(), c.byref(value))
        return value.value if known else None

    def set(self, name, value):
        """While nothing is processed."""
        self.flush([value_event(self.parameters[name].id, value)])

    def flush(self, events=()):
        lists = Events(events)
        self.call("params", "flush", c.byref(lists.input), c.byref(lists.output))
        return lists.sent

    def save(self, most=1 << 30):
        """The state, written at most so many bytes at a time; None if that fails."""
        data = bytearray()

        def write(_, buffer, size):
            size = min(size, most)
            if size == 0:
                return -1
            data.extend(c.string_at(buffer, size))
            return size

        stream = Stream(None, Stream._fields_[1][1](write))
        return bytes(data) if self.call("state", "save", c.byref(stream)) else None

    def load(self, data, most=1 << 30, fails_at=None):
        at = 0

        def read(_, buffer, size):
            nonlocal at
            if fails_at is not None and at >= fails_at:
                return -1
            some = data[at : at + min(size, most)]
            c.memmove(buffer, some, len(some))
            at += len(some)
            return len(some)

        stream = Stream(None, Stream._fields_[1][1](read))
        return self.call("state", "load", c.byref(stream))

    def process(self, inputs, outputs, begin=0, frames=None, lists=None):
        """One block. Inputs and outputs are lists of ports, which are arrays of channels and frames, or None."""
        if frames is None:
            frames = next(port for port in [*inputs, *outputs] if port is not None).shape[1]

        kept = []

        def buffers(ports):
            made = (Buffer * max(len(ports), 1))()
            for buffer, port in zip(made, ports):
                if port is not None:
                    pointers = (void * len(port))(*[channel.ctypes.data + 4 * begin for channel in port])
                    kept.append(pointers)
                    buffer.data32, buffer.channels = c.cast(pointers, c.POINTER(void)), len(port)
                buffer.constant = (1 << 64) - 1
            return made

        lists = lists or Events()
        into, out = buffers(inputs), buffers(outputs)
        status = self.struct.process(
            self.at,
            c.byref(
                Process(
                    -1,
                    frames,
                    None,
                    into,
                    out,
                    len(inputs),
                    len(outputs),
                    c.pointer(lists.input),
                    c.pointer(lists.output),
                )
            ),
        )
        self.constants = [port.constant for port in out[: len(outputs)]]
        return status

    def render(self, sound, block=512, events=(), sidechain=True, in_place=False, haptics=1):
        """Left, right and sidechain become left, right and haptics; events are (frame, identifier, value, kind)."""
        sound = np.array(sound, dtype=np.float32)
        main = sound[:2] if in_place else np.full((2, sound.shape[1]), np.nan, dtype=np.float32)
        haptic = np.full((haptics, sound.shape[1]), np.nan, dtype=np.float32)
        inputs = [sound[:2], sound[2:3]][: 2 if sidechain else 1]
        blocks = [block] if isinstance(block, int) else list(block)
        at = number = 0
        self.sent, self.statuses = [], set()
        while at < sound.shape[1]:
            frames = min(blocks[number % len(blocks)], sound.shape[1] - at)
            number += 1
            lists = Events(
                [
                    value_event(identifier, value, frame - at, kind)
                    for frame, identifier, value, kind in events
                    if at <= frame < at + frames
                ]
            )
            self.statuses.add(self.process(inputs, [main, haptic], at, frames, lists))
            self.sent += lists.sent
            at += frames
        return np.concatenate([main, haptic])
