"""HID devices on a cable that exist only for programs run under umockdev-wrapper: they note what is written to them."""
import errno
import struct
import threading
import time
from pathlib import Path

import gi

gi.require_version("UMockdev", "1.0")
from gi.repository import GLib, UMockdev  # noqa: E402

HIDIOCGRDESCSIZE, HIDIOCGRDESC = 0x80044801, 0x90044802
HIDIOCSFEATURE, HIDIOCGFEATURE, FEATURE_SIZE = 0xC0004806, 0xC0004807, 0x3FFF0000  # the size of the report is part of the request
NODE = "/dev/hidraw0"
USB = "/devices/pci0000:00/0000:00:14.0/usb1/1-1"
INTERFACE = USB + "/1-1:1.0"

# The least that is a gamepad: reports of 63 bytes, 30, 21 and 81 to the computer, 01, 10, 80 and 82 from it.
GAMEPAD = (bytes.fromhex("05010904a101 0600ff 1500 26ff00 7508 953f")
           + b"".join(bytes([0x85, number, 0x09, number, 0x81, 0x03]) for number in (0x30, 0x21, 0x81))
           + b"".join(bytes([0x85, number, 0x09, number, 0x91, 0x83]) for number in (0x01, 0x10, 0x80, 0x82))
           + bytes([0xC0]))

# A touchpad: fingers in report 1; feature report 5 lists the waveforms of the ordinals 3 to 5 and how long they last,
# output report 6 triggers one: ordinal, intensity of 0 to 100, repeats, ms between them.
TOUCHPAD = bytes.fromhex("050d0905a101 8501 0922a102 15002501 7501 9502 0947 0942 8102 9506 8103"
                         "0501 26ff0f 7510 9502 0930 0931 8102 c0"
                         "050e0901a102 8505 0910a102 050a 1903 2905 160110 26ff2f 7510 9503 b102 c0"
                         "050e0911a102 050a 1903 2905 1500 26ff00 7508 9503 b102 c0 c0"
                         "050e0901a102 8506 0921 1501 2505 7508 9501 9102 0923 1500 2564 9102 0924 2505 9102"
                         "0925 26e803 7510 9102 c0 c0")

# What Valve's devices have is not known to us; these have what counts here: a page of the maker's, output reports 86 and
# 88, or a feature report without a number.
STEAM_REPORTS = bytes.fromhex("0600ff 0901 a101 1500 26ff00 7508 953f 8586 0901 9102 8588 0901 9102 c0")
DECK_REPORTS = bytes.fromhex("06ffff 0901 a101 1500 26ff00 7508 9540 0901 8102 0901 b102 c0")
KEYBOARD = bytes.fromhex("05010906a101 050719e029e7 15002501 75019508 8102 c0")

PRO_CONTROLLER = {"maker": 0x057E, "product": 0x2009, "by": "Nintendo Co., Ltd.", "name": "Pro Controller",
                  "descriptor": GAMEPAD, "features": {}}
DUALSHOCK_4 = PRO_CONTROLLER | {"maker": 0x054C, "product": 0x09CC, "by": "Sony", "name": "Wireless Controller"}

# Firmware 6.30 in feature report 20; on a cable with a sound card, on Bluetooth with another number of the bus.
DUALSENSE = PRO_CONTROLLER | {"maker": 0x054C, "product": 0x0CE6, "by": "Sony Interactive Entertainment",
                              "name": "DualSense Wireless Controller", "card": 7,
                              "features": {0x20: bytes([0x20]) + bytes(43) + bytes([0x30, 0x06]) + bytes(18)}}
DUALSENSE_BLUETOOTH = {name: value for name, value in DUALSENSE.items() if name != "card"} | {"bus": "0005"}

STEAM_CONTROLLER = {"maker": 0x28DE, "product": 0x1302, "by": "Valve Software", "name": "Steam Controller",
                    "descriptor": STEAM_REPORTS, "features": {}}
STEAM_RECEIVER = STEAM_CONTROLLER | {"product": 0x1304, "name": "Steam Controller Puck"}
STEAM_DECK = {"maker": 0x28DE, "product": 0x1205, "by": "Valve Software", "name": "Steam Deck Controller",
              "descriptor": DECK_REPORTS, "features": {}}
DECK_KEYBOARD = STEAM_DECK | {"descriptor": KEYBOARD}


def touchpad(waveforms, durations):
    """A touchpad that lists these, three each."""
    return {"maker": 0x06CB, "product": 0x1234, "by": "Example", "name": "Haptic Touchpad", "descriptor": TOUCHPAD,
            "features": {5: struct.pack("<B3H3B", 5, *waveforms, *durations)}}


def description(device):
    """What umockdev has to be told; the device is the only one."""
    ids = f"{device['maker']:04X}:{device['product']:04X}"
    hid = f"{INTERFACE}/0003:{ids}.0001"
    card = "" if "card" not in device else f"""P: {USB}/1-1:1.1
E: DEVTYPE=usb_interface
E: SUBSYSTEM=usb
A: bInterfaceNumber=01\\n

P: {USB}/1-1:1.1/sound/card{device['card']}
E: SUBSYSTEM=sound
A: number={device['card']}\\n

"""
    return card + f"""P: {USB}
E: DEVTYPE=usb_device
E: PRODUCT={device['maker']:x}/{device['product']:x}/210
E: SUBSYSTEM=usb
A: idVendor={device['maker']:04x}\\n
A: idProduct={device['product']:04x}\\n
A: bcdDevice=0210\\n
A: manufacturer={device['by']}\\n
A: product={device['name']}\\n
A: serial=000000000001\\n

P: {INTERFACE}
E: DEVTYPE=usb_interface
E: DRIVER=usbhid
E: INTERFACE=3/0/0
E: PRODUCT={device['maker']:x}/{device['product']:x}/210
E: SUBSYSTEM=usb
A: bInterfaceNumber=00\\n

P: {hid}
E: DRIVER=hid-generic
E: HID_ID={device.get("bus", "0003")}:0000{device['maker']:04X}:0000{device['product']:04X}
E: HID_NAME={device['by']} {device['name']}
E: HID_PHYS=usb-0000:00:14.0-1/input0
E: HID_UNIQ=000000000001
E: SUBSYSTEM=hid
H: report_descriptor={device['descriptor'].hex().upper()}

P: {hid}/hidraw/hidraw0
N: hidraw0
E: DEVNAME={NODE}
E: MAJOR=240
E: MINOR=0
E: SUBSYSTEM=hidraw
L: device=../../../0003:{ids}.0001
A: dev=240:0\\n
"""


class FakeController:
    """One of those above, connected by connect(). `writes` are the times (monotonic, s) and the bytes of all reports since clear()."""

    def __init__(self, device=None):
        self.device = device or PRO_CONTROLLER
        self.asked = []  # feature reports, by number
        self.bed = UMockdev.Testbed.new()
        self.writes = []
        self.pulled = False
        self.refused = ()  # numbers of reports
        self.changed = threading.Condition()
        self.handler = UMockdev.IoctlBase()
        self.handler.connect("handle-ioctl", self.on_ioctl)
        self.handler.connect("handle-write", self.on_write)
        self.handler.connect("handle-read", self.on_read)
        threading.Thread(target=GLib.MainLoop().run, daemon=True).start()

    def connect(self):
        self.bed.add_from_string(description(self.device))
        self.bed.attach_ioctl(NODE, self.handler)

    def unplug(self):
        """From now on the kernel knows no such device, for those who have it open either."""
        self.pulled = True
        ids = f"{self.device['maker']:04X}:{self.device['product']:04X}"
        self.bed.uevent(f"/sys{INTERFACE}/0003:{ids}.0001/hidraw/hidraw0", "remove")

    def take_away(self):
        """As unplug(), and its node is gone too."""
        self.unplug()
        Path(self.bed.get_root_dir() + NODE).unlink()

    def clear(self):
        with self.changed:
            self.writes.clear()
        self.pulled = False

    def wait_for(self, count, seconds=30):
        """Whether so many reports have come in time."""
        with self.changed:
            return self.changed.wait_for(lambda: len(self.writes) >= count, seconds)

    def on_write(self, _, client):
        now = time.monotonic()
        if self.pulled:
            client.complete(-1, errno.ENODEV)
            return True
        report = bytes(client.get_arg().retrieve())
        if report[0] in self.refused:
            client.complete(-1, errno.EINVAL)
        else:
            self.note(client, now, report)
        return True

    def note(self, client, now, report):
        with self.changed:
            self.writes.append((now, report))
            self.changed.notify_all()
        client.complete(len(report), 0)

    def on_read(self, _, client):
        client.complete(-1, errno.EAGAIN)
        return True

    def on_ioctl(self, _, client):
        request, argument = client.get_request() & 0xFFFFFFFF, client.get_arg()
        descriptor = self.device["descriptor"]
        size = struct.pack("<i", len(descriptor))
        if request == HIDIOCGRDESCSIZE:
            argument.resolve(0, 4).update(0, list(size))
        elif request == HIDIOCGRDESC:
            argument.resolve(0, 4 + 4096).update(0, list(size + descriptor))
        elif request & ~FEATURE_SIZE == HIDIOCSFEATURE:
            if self.pulled:
                client.complete(-1, errno.ENODEV)
            else:
                self.note(client, time.monotonic(), bytes(argument.resolve(0, (request & FEATURE_SIZE) >> 16).retrieve()))
            return True
        elif request & ~FEATURE_SIZE == HIDIOCGFEATURE:
            return self.on_feature(client, argument.resolve(0, (request & FEATURE_SIZE) >> 16))
        else:
            client.complete(-1, errno.ENOTTY)
            return True
        client.complete(0, 0)
        return True

    def on_feature(self, client, buffer):
        number = bytes(buffer.retrieve())[0]
        self.asked.append(number)
        answer = self.device["features"].get(number)
        if answer is None or self.pulled:
            client.complete(-1, errno.ENODEV if self.pulled else errno.EPIPE)
            return True
        buffer.update(0, list(answer[:len(bytes(buffer.retrieve()))]))
        client.complete(len(answer), 0)
        return True
