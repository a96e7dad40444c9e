#!/usr/bin/env python3
"""The Debian package, made from what is built.

check_deb.py SOURCE BUILD PACINI               what is in it, and what it says of itself
check_deb.py SOURCE BUILD PACINI --bare-root   installed in a new Debian that has nothing else, tried and removed; needs
                                               root, debootstrap, and a network at the first time
"""
import gzip
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

SOURCE, BUILD, PACINI = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
sys.path += [str(SOURCE / "Tests/hosts"), str(SOURCE / "Tests/library")]
import installed  # noqa: E402
from host_test import Processes, check, failures, needs, until  # noqa: E402

PROGRAMS = ("pacini", "pacini-bench", "PaciniEditor", "PaciniStandalone")
SOUND = "demo/knock_wood_bridge.flac"


def skip(why):
    print("SKIPPED:", why)
    sys.exit(77)


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{done.stdout.decode(errors='replace')[-3000:]}\n"
                 f"{done.stderr.decode(errors='replace')[-3000:]}")
    return done.stdout


def make_package(folder, *options):
    run("cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", folder, *options)
    [package] = folder.glob("*.deb")
    return package


def files_below(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir()}


# What is in it.

def expected_files(architecture):
    core, resources = SOURCE / "Core", SOURCE / "Resources"
    files = {f"usr/bin/{program}" for program in PROGRAMS}
    files |= {f"usr/share/man/man1/{program}.1.gz" for program in PROGRAMS}
    files |= {f"usr/include/{path.relative_to(core)}" for path in core.glob("pacini/**/*.h")}
    files |= {f"usr/share/pacini/{folder.name}/{path.name}"
              for folder in (SOURCE / "profiles", resources / "schema", resources / "demo") for path in folder.iterdir()}
    libraries = f"usr/lib/{architecture}-linux-gnu"
    header = (SOURCE / "Source/library/include/pacini.h").read_text()
    interface = ".".join(re.search(rf"PACINI_API_{part} (\d+)", header)[1] for part in ("MAJOR", "MINOR"))
    files |= {f"{libraries}/cmake/Pacini/{name}.cmake" for name in (
        "pacini-config", "pacini-config-version", "PaciniTargets", "PaciniLibraryTargets", "PaciniLibraryTargets-release")}
    files |= {f"{libraries}/{name}" for name in ("libpacini.so", "libpacini.so.1", f"libpacini.so.{interface}.0", "libpacini.a",
                                                "pkgconfig/pacini.pc")}
    files.add("usr/include/pacini.h")
    files |= {f"usr/lib/lv2/Pacini.lv2/{name}" for name in ("libPacini.so", "manifest.ttl", "dsp.ttl", "ui.ttl")}
    files.add("usr/lib/clap/Pacini.clap")
    return files | {f"usr/lib/vst3/Pacini.vst3/Contents/{architecture}-linux/Pacini.so",
                    "usr/lib/udev/rules.d/70-pacini.rules",
                    "usr/share/pkgconfig/pacini-core.pc",
                    "usr/share/bash-completion/completions/pacini",
                    "usr/share/fish/vendor_completions.d/pacini.fish",
                    "usr/share/zsh/vendor-completions/_pacini",
                    "usr/share/applications/pacini.desktop", "usr/share/applications/pacini-editor.desktop",
                    "usr/share/icons/hicolor/scalable/apps/pacini.svg",
                    "usr/share/doc/pacini/copyright", "usr/share/doc/pacini/CHANGELOG.md",
                    "usr/share/lintian/overrides/pacini"}


def check_fields(package):
    text = run("dpkg-deb", "--field", package).decode()
    fields = dict(re.findall(r"(?m)^([\w-]+): (.*)$", text))
    version = run(PACINI, "--version").decode().split()[1]
    architecture = run("dpkg", "--print-architecture").decode().strip()
    check("it is named after package, version and machine", package.name == f"pacini_{version}_{architecture}.deb", package.name)
    for field, value in (("Package", "pacini"), ("Version", version), ("Architecture", architecture), ("Section", "sound"),
                         ("Priority", "optional")):
        check(f"{field} is {value}", fields.get(field) == value, fields.get(field))
    for field in ("Maintainer", "Homepage", "Installed-Size", "Description"):
        check(f"{field} is told", bool(fields.get(field)))
    depends = fields.get("Depends", "")
    for library in ("libc6", "libstdc++6", "libsndfile1", "libcairo2", "libfreetype6", "libasound2"):
        check(f"needs {library} of some version", re.search(rf"(^| ){re.escape(library)}(t64)? \(>= ", depends) is not None)
    check("needs the libraries of windows", "libx11-6" in depends)
    check("others that need libpacini will need this package",
          re.fullmatch(r"libpacini 1 pacini \(>= [\d.]+\)\n", run("dpkg-deb", "--info", package, "shlibs").decode()) is not None)
    check("the linker's list is made anew",
          all(b"ldconfig" in run("dpkg-deb", "--info", package, script) for script in ("postinst", "postrm")))
    for line in run("dpkg-deb", "--contents", package).decode().splitlines():
        rights, owner, name = line.split()[0], line.split()[1], line.split()[5]
        right = ("drwxr-xr-x" if name.endswith("/") else "lrwxrwxrwx" if " -> " in line else
                 "-rwxr-xr-x" if "/usr/bin/" in name else "-rw-r--r--")
        if (rights, owner) != (right, "root/root"):
            check(f"{name} has the usual rights", False, f"{rights} {owner}")


def check_binaries(tree):
    binaries = [path for path in tree.rglob("*")
                if path.is_file() and not path.is_symlink() and path.read_bytes()[:4] == b"\x7fELF"]
    check("programs, three plugins and a library are compiled", len(binaries) == len(PROGRAMS) + 4)
    for path in binaries:
        dynamic = run("readelf", "--dynamic", path).decode()
        check(f"{path.name} looks for no library in a place of its own", "RPATH" not in dynamic and "RUNPATH" not in dynamic)
        check(f"{path.name} is stripped", " .symtab" not in run("readelf", "--sections", "--wide", path).decode())


def check_texts(tree):
    for path in tree.rglob("*"):
        if path.is_file():
            data = path.read_bytes()
            if path.suffix == ".gz":
                data = gzip.decompress(data)
            for folder in {str(SOURCE), str(BUILD)}:
                if folder.encode() in data:
                    check(f"{path.relative_to(tree)} names no folder of the machine it was built on", False, folder)
    for program in PROGRAMS:
        page = gzip.decompress((tree / f"usr/share/man/man1/{program}.1.gz").read_bytes())
        if page == b".so man1/pacini.1\n":
            page = gzip.decompress((tree / "usr/share/man/man1/pacini.1.gz").read_bytes())
        done = subprocess.run(["groff", "-man", "-Tutf8", "-ww"], input=page, capture_output=True, check=False)
        check(f"the manual page of {program} has no mistakes",
              done.returncode == 0 and not done.stderr and len(done.stdout) > 500, done.stderr.decode())
    for path in (tree / "usr/share/applications").iterdir():
        entry = dict(line.split("=", 1) for line in path.read_text(encoding="utf-8").splitlines() if "=" in line)
        check(f"{path.name} starts a program that is there", (tree / "usr/bin" / entry["Exec"].split()[0]).exists())
        check(f"{path.name} has an icon", (tree / f"usr/share/icons/hicolor/scalable/apps/{entry['Icon']}.svg").exists())
    picture = xml.etree.ElementTree.parse(tree / "usr/share/icons/hicolor/scalable/apps/pacini.svg").getroot()
    check("the icon is a square picture", picture.get("viewBox") == "0 0 64 64")

    text = (tree / "usr/share/doc/pacini/copyright").read_text(encoding="utf-8")
    stanzas = [dict(re.findall(r"(?m)^([\w-]+):\s*((?:.*\n?)(?:^ .*\n?)*)", stanza)) for stanza in re.split(r"\n\n+", text)]
    check("the licences are machine-readable", stanzas[0].get("Format", "").startswith("https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/"))
    explained = {stanza["License"].split("\n")[0] for stanza in stanzas if "License" in stanza and "Files" not in stanza}
    used = {stanza["License"].split("\n")[0] for stanza in stanzas if "Files" in stanza}
    check("every licence is explained, and no other", used == explained, used ^ explained)
    check("every stanza says whose it is", all(stanza.get("Copyright", "").strip() for stanza in stanzas if "Files" in stanza))
    flat = " ".join(text.replace("\n .\n", "\n").split())
    ours = " ".join((SOURCE / "LICENSE").read_text(encoding="utf-8").partition("Permission is")[2].split())
    check("our licence is there word for word", ours in flat)
    for sound in (SOURCE / "Resources/demo").glob("*.flac"):
        check(f"{sound.name} has a licence", f"Resources/demo/{sound.name}\n" in text)


def check_library(tree, folder):
    """As it lies in the package, which can be anywhere."""
    programs = installed.built(tree / "usr", folder / "example")
    played = installed.played(tree / "usr", programs)
    check("libpacini is found and linked in every way, and plays", len(set(played.values())) == 1 and len(played) == 4 and
          max(map(len, played.values())) > 100000)


def check_contents(folder):
    package = make_package(folder / "package", "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none")
    check_fields(package)
    tree = folder / "tree"
    run("dpkg-deb", "--extract", package, tree)
    found, wanted = files_below(tree), expected_files(os.uname().machine)
    check("nothing is missing", wanted <= found, sorted(wanted - found))
    check("nothing else is in it", found <= wanted, sorted(found - wanted))
    check_binaries(tree)
    check_texts(tree)
    check_library(tree, folder)
    run("cmake", "--install", BUILD, "--prefix", folder / "prefix")
    check("`cmake --install` gives the same tree", {f"usr/{name}" for name in files_below(folder / "prefix")} == found)
    listed = run(folder / "prefix/bin/pacini", "profiles").decode()
    check("the installed command has its profiles", all(path.stem in listed for path in (SOURCE / "profiles").iterdir()))


# In a bare root.

# Before a command: its mounts and processes end with it, and it ends with this test, however that ends.
PRIVATE = ("setpriv", "--pdeathsig", "KILL", "unshare", "--mount", "--propagation", "private", "--pid", "--fork",
           "--kill-child")


def private(*command, **options):
    options.setdefault("input", b"")
    return subprocess.run([*PRIVATE, *map(str, command)], capture_output=True, check=False, **options)


def base_system():
    """A minimal Debian as debootstrap leaves it, of the version that runs here; made once."""
    name = next((line.partition("=")[2].strip().strip('"') for line in Path("/etc/os-release").read_text().splitlines()
                 if line.startswith("VERSION_CODENAME=")), "")
    base, part = BUILD / f"bare-root/{name}", BUILD / "bare-root/part"
    if base.exists():
        return base
    sources = run("apt-get", "indextargets", "--format", "$(REPO_URI) $(RELEASE)", "Created-By: Packages").decode()
    mirror = next((line.split()[0] for line in sources.splitlines() if line.split()[1] == name), None)
    if not mirror:
        skip(f"apt knows no source of {name}")
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    done = private("debootstrap", "--variant=minbase", name, part, mirror)
    if done.returncode != 0:
        shutil.rmtree(part, ignore_errors=True)
        skip("debootstrap failed: " + done.stdout.decode(errors="replace")[-500:] + done.stderr.decode(errors="replace")[-500:])
    part.rename(base)
    return base


class BareRoot:
    """A copy of the base system that goes to the same sources of packages as this machine, in the same way."""

    def __init__(self, folder):
        self.folder = folder
        run("cp", "-a", base_system(), folder)
        for name in ("resolv.conf", "hosts", "ssl/certs/ca-certificates.crt"):
            if Path("/etc", name).exists():
                self.copy(f"/etc/{name}")
        (folder / "etc/apt/sources.list").unlink(missing_ok=True)
        for pattern in ("sources.list", "sources.list.d/*.list", "sources.list.d/*.sources", "trusted.gpg.d/*", "keyrings/*"):
            for path in Path("/etc/apt").glob(pattern):
                self.copy(path)
        for path in Path("/usr/share/keyrings").glob("*"):
            self.copy(path)
        ways = re.findall(r"(?m)^Acquire::(?:https?|Check|Retries)\b.*", run("apt-config", "dump").decode())
        (folder / "etc/apt/apt.conf.d/90host").write_text("\n".join(ways) + "\n")
        for path in re.findall(r'"(/[^"]+)"', "\n".join(ways)):  # certificates of its own
            if Path(path).is_file():
                self.copy(path)

    def copy(self, path):
        target = self.folder / str(path).lstrip("/")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.unlink(missing_ok=True)
        shutil.copy(path, target)

    def command(self, *command):
        return ("sh", "-c", 'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" "$@"', self.folder,
                *command)

    def environment(self, **more):
        ways = {name: value for name, value in os.environ.items() if name.lower().endswith("_proxy")}
        return {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8",
                "DEBIAN_FRONTEND": "noninteractive", **ways, **more}

    def run(self, *command, **options):
        return private(*self.command(*command), env=self.environment(), **options)

    def must(self, *command, **options):
        done = self.run(*command, **options)
        if done.returncode != 0:
            sys.exit(f"failed in the bare root: {' '.join(map(str, command))}\n{done.stdout.decode(errors='replace')[-3000:]}\n"
                     f"{done.stderr.decode(errors='replace')[-3000:]}")
        return done.stdout

    def install(self, *packages):
        self.must("apt-get", "install", "-y", "-q", "--no-install-recommends", *packages)


def check_command(root):
    def clip_and_drive(runner, program, sound, profile):
        clip = runner(program, "encode", sound, "-o", "-", "--format", "packed")
        return clip, runner(program, "render", "-", "-o", "-", "--profile", profile, input=clip)

    check("it tells its version", root.must("pacini", "--version") == run(PACINI, "--version"))
    listed = root.must("pacini", "profiles").decode()
    check("it has its profiles", all(path.stem in listed for path in (SOURCE / "profiles").iterdir()))
    there = clip_and_drive(root.must, "pacini", f"/usr/share/pacini/{SOUND}", "l5-wristband")
    here = clip_and_drive(run, PACINI, SOURCE / "Resources" / SOUND, "l5-wristband")
    check("a demo sound becomes the same clip", there[0] == here[0] and len(here[0]) > 100)
    check("a clip becomes the same drive signal", there[1] == here[1] and len(here[1]) > 10000)
    root.must("pacini", "encode", "/usr/share/pacini/demo", "-o", "/tmp/clips", "--format", "packed")
    root.must("pacini", "render", "/usr/share/pacini/demo/workshop.scene.json", "--clips", "/tmp/clips", "-o", "/tmp/workshop.wav")
    check("the demo scene is rendered", (root.folder / "tmp/workshop.wav").stat().st_size > 100000)
    root.must("pacini", "bench", "decimate", "-o", "/tmp/bench")
    check("it measures on its demo sounds", any((root.folder / "tmp/bench").iterdir()))


def check_libraries(root):
    known = root.must("ldconfig", "-p").decode()
    binaries = [f"/usr/bin/{program}" for program in PROGRAMS]
    binaries += ["/" + str(path.relative_to(root.folder)) for path in (root.folder / "usr/lib").glob("*/Pacini.*/**/*.so")]
    binaries.append("/usr/lib/clap/Pacini.clap")
    check("programs and plugins are installed", len(binaries) == len(PROGRAMS) + 3)
    check("the linker knows libpacini", "libpacini.so.1 " in known)
    for binary in binaries:
        check(f"{binary} finds its libraries", b"not found" not in root.must("ldd", binary))
        # By name, at run time.
        later = set(re.findall(rb"\blibX\w+\.so\.\d", (root.folder / binary[1:]).read_bytes()))
        missing = [name.decode() for name in later if name.decode() not in known]
        check(f"{binary} will find what it opens later", not missing, missing)
        check(f"{binary} has windows or is a command", bool(later) != binary.startswith("/usr/bin/pacini"))
    # There is no compiler: what was built on this machine runs there.
    example = installed.built(root.folder / "usr", root.folder / "tmp/example")["pkg-config"]
    shutil.copy(installed.CLIP, root.folder / "tmp/clip.json")
    check("a program that is linked to libpacini plays",
          len(root.must("/" + str(example.relative_to(root.folder)), "/tmp/clip.json")) > 100000)


def check_windows(root, processes):
    """On a screen of this machine: their sockets have no path, and so are those of the bare root too."""
    screen = processes.start_screen()
    for program, title in (("PaciniEditor", "Pacini Editor"), ("PaciniStandalone", "Pacini")):
        check(f"{program} tells its version", root.must(program, "--version").strip().replace(b".", b"").isdigit())
        processes.start(*PRIVATE, *root.command(program, "--fresh"), env=root.environment(DISPLAY=screen))
        shown = until(lambda: subprocess.run(["xdotool", "search", "--onlyvisible", "--class", f"^{title}$"], capture_output=True,
                                             check=False, env=dict(os.environ, DISPLAY=screen)).stdout)
        check(f"{program} opens a window of the class that its desktop file names", shown)


def check_with_tools(root):
    root.install("man-db", "lilv-utils", "desktop-file-utils")
    check("hosts of LV2 see the plugin", b"urn:pacini:translator" in root.must("lv2ls"))
    described = root.must("lv2info", "urn:pacini:translator")
    check("it says what it is", b"Name:" in described and b"Pacini" in described)
    for program in PROGRAMS:
        page = root.must("man", program).decode()
        check(f"man {program}", "NAME" in page and program in page)
    files = [f"/usr/share/applications/{name}.desktop" for name in ("pacini", "pacini-editor")]
    done = root.run("desktop-file-validate", *files)
    check("the desktop files are valid", done.returncode == 0 and not done.stdout + done.stderr, done.stdout + done.stderr)
    done = root.run("bash", "-c", ". /usr/share/bash-completion/completions/pacini && complete -p pacini")
    check("bash completes the command", done.returncode == 0 and b"pacini" in done.stdout, done.stderr)


def check_bare_root(folder):
    if os.geteuid() != 0:
        skip("only root can make a bare root")
    needs("debootstrap", "setpriv", "unshare", "Xvfb", "xdotool")
    if private("true").returncode != 0:
        skip("nothing can be mounted here")
    root = BareRoot(folder / "root")
    shutil.copy(make_package(folder / "package"), root.folder / "tmp/pacini.deb")
    done = root.run("apt-get", "update", "-q", "-o", "APT::Update::Error-Mode=any")
    if done.returncode != 0:
        skip("lists of packages cannot be had: " + done.stderr.decode(errors="replace")[-500:])
    root.install("/tmp/pacini.deb")
    check_libraries(root)
    check_command(root)
    with Processes() as processes:
        check_windows(root, processes)
    check_with_tools(root)
    installed = [line for line in root.must("dpkg", "-L", "pacini").decode().splitlines() if (root.folder / line[1:]).is_file()]
    root.must("apt-get", "purge", "-y", "-q", "pacini")
    left = [name for name in installed if (root.folder / name[1:]).exists()]
    check("removed it leaves nothing", len(installed) > 100 and not left, left)


def main():
    needs("cpack", "dpkg-deb", "dpkg-shlibdeps", "readelf", "groff")
    # Beside the build: a root is too big for /tmp.
    with tempfile.TemporaryDirectory(dir=BUILD, prefix="package-") as folder:
        (check_bare_root if "--bare-root" in sys.argv else check_contents)(Path(folder))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
