"""A Pro Controller on a cable that exists only for programs run under umockdev-wrapper: notes what is written to it."""
import errno
import struct
import threading
import time

import gi

gi.require_version("UMockdev", "1.0")
from gi.repository import GLib, UMockdev  # noqa: E402

HIDIOCGRDESCSIZE, HIDIOCGRDESC = 0x80044801, 0x90044802
NODE = "/dev/hidraw0"
USB = "/devices/pci0000:00/0000:00:14.0/usb1/1-1"
INTERFACE = USB + "/1-1:1.0"
HID = INTERFACE + "/0003:057E:2009.0001"

# The least that is a gamepad: reports of 63 bytes, 30, 21 and 81 to the computer, 01, 10, 80 and 82 from it.
DESCRIPTOR = (bytes.fromhex("05010904a101 0600ff 1500 26ff00 7508 953f")
              + b"".join(bytes([0x85, number, 0x09, number, 0x81, 0x03]) for number in (0x30, 0x21, 0x81))
              + b"".join(bytes([0x85, number, 0x09, number, 0x91, 0x83]) for number in (0x01, 0x10, 0x80, 0x82))
              + bytes([0xC0]))

DESCRIPTION = f"""P: {USB}
E: DEVTYPE=usb_device
E: PRODUCT=57e/2009/210
E: SUBSYSTEM=usb
A: idVendor=057e\\n
A: idProduct=2009\\n
A: bcdDevice=0210\\n
A: manufacturer=Nintendo Co., Ltd.\\n
A: product=Pro Controller\\n
A: serial=000000000001\\n

P: {INTERFACE}
E: DEVTYPE=usb_interface
E: DRIVER=usbhid
E: INTERFACE=3/0/0
E: PRODUCT=57e/2009/210
E: SUBSYSTEM=usb
A: bInterfaceNumber=00\\n

P: {HID}
E: DRIVER=nintendo
E: HID_ID=0003:0000057E:00002009
E: HID_NAME=Nintendo Co., Ltd. Pro Controller
E: HID_PHYS=usb-0000:00:14.0-1/input0
E: HID_UNIQ=000000000001
E: SUBSYSTEM=hid
H: report_descriptor={DESCRIPTOR.hex().upper()}

P: {HID}/hidraw/hidraw0
N: hidraw0
E: DEVNAME={NODE}
E: MAJOR=240
E: MINOR=0
E: SUBSYSTEM=hidraw
L: device=../../../0003:057E:2009.0001
A: dev=240:0\\n
"""


class FakeController:
    """Connected by connect(). `writes` are the times (monotonic, s) and the bytes of all reports since clear()."""

    def __init__(self):
        self.bed = UMockdev.Testbed.new()
        self.writes = []
        self.pulled = False
        self.changed = threading.Condition()
        self.handler = UMockdev.IoctlBase()
        self.handler.connect("handle-ioctl", self.on_ioctl)
        self.handler.connect("handle-write", self.on_write)
        self.handler.connect("handle-read", self.on_read)
        threading.Thread(target=GLib.MainLoop().run, daemon=True).start()

    def connect(self):
        self.bed.add_from_string(DESCRIPTION)
        self.bed.attach_ioctl(NODE, self.handler)

    def unplug(self):
        """From now on the kernel knows no such device, for those who have it open either."""
        self.pulled = True
        self.bed.uevent("/sys" + HID + "/hidraw/hidraw0", "remove")

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
        with self.changed:
            self.writes.append((now, report))
            self.changed.notify_all()
        client.complete(len(report), 0)
        return True

    def on_read(self, _, client):
        client.complete(-1, errno.EAGAIN)
        return True

    def on_ioctl(self, _, client):
        request, argument = client.get_request(), client.get_arg()
        size = struct.pack("<i", len(DESCRIPTOR))
        if request == HIDIOCGRDESCSIZE:
            argument.resolve(0, 4).update(0, list(size))
        elif request == HIDIOCGRDESC:
            argument.resolve(0, 4 + 4096).update(0, list(size + DESCRIPTOR))
        else:
            client.complete(-1, errno.ENOTTY)
            return True
        client.complete(0, 0)
        return True
