"""The list of what is in each package of a release and under which licences, as an SPDX 2.3 document.

Resources/package/contents.json names what is compiled into the packages; copyright beside it says whose that is, as far
as the Debian package has it. What lies in a package as a file of its own, such as a library that others may replace, is
looked for.
"""
import datetime
import hashlib
import importlib.metadata
import json
import re
import subprocess
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# Debian's names of licences that have others in SPDX.
NAMES = {"Expat": "MIT", "GPL-3+": "GPL-3.0-or-later", "GPL-3": "GPL-3.0-only",
         "public-domain": "LicenseRef-public-domain"}
PUBLIC_DOMAIN = "Their authors gave up all rights: anyone may do anything with them."
PURPOSES = {"source": "SOURCE", "sdist": "SOURCE", "crate": "SOURCE", "wheel": "LIBRARY", "npm": "LIBRARY",
            "deb": "INSTALL", "zip": "ARCHIVE", "setup": "INSTALL"}


class Unknown(Exception):
    """Something is in a package of which nobody said what it is."""


def stanzas(text):
    """The stanzas of a machine-readable copyright file that are about files: first file, copyright, licence by SPDX."""
    found = {}
    for stanza in re.split(r"\n\n+", text):
        fields = dict(re.findall(r"(?m)^([\w-]+):[ \n]*((?:.*\n?)(?:^ .*\n?)*)", stanza + "\n"))
        if "Files" in fields:
            licence = fields["License"].split("\n")[0].strip()
            lines = [line.strip() for line in fields["Copyright"].strip().splitlines()]
            found[fields["Files"].split()[0]] = ("; ".join(lines), NAMES.get(licence, licence))
    return found


def contents():
    return json.loads((ROOT / "Resources/package/contents.json").read_text(encoding="utf-8"))


def all_of(licences):
    """An expression of all `licences`, each once."""
    parts = sorted({part for licence in licences for part in licence.split(" AND ")})
    return " AND ".join(parts)


def version_of(component, own, path):
    """The version of a component in the package at `path`; None where none is known."""
    if "debian" in component:
        done = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", component["debian"]], capture_output=True,
                              text=True, check=False)
        if done.returncode != 0:
            raise Unknown(f"{component['name']}: the package {component['debian']} is not installed")
        return done.stdout
    if "python" in component:
        return importlib.metadata.version(component["python"])
    if "text" in component:
        with zipfile.ZipFile(path) as archive:
            [name] = [name for name in archive.namelist() if name.endswith("/bin/sndfile.dll")]
            return re.search(component["text"].encode(), archive.read(name))[1].decode()
    return own if "stanza" in component else None


def libraries_in(path):
    """Names of the libraries that lie in a wheel or a zip as files of their own."""
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            if re.match(r"pacini\.libs/.", name):
                yield name.partition("/")[2]
            elif name.lower().endswith(".dll"):
                yield name.partition("/")[2]


def owners_of_libraries(path, known):
    """The components whose libraries lie in a package, each once."""
    found = []
    for library in libraries_in(path):
        owners = [owner for start, owner in known["files"].items() if library.startswith(start)]
        if len(owners) != 1:
            raise Unknown(f"{path.name}: {library} is not in Resources/package/contents.json")
        found += [owner for owner in owners if owner not in found]
    return found


def components_of(kind, path, known):
    """The components in a package: what is compiled in, and what is found in it."""
    found = list(known["packages"][kind])
    if kind in ("wheel", "zip"):
        found += [owner for owner in owners_of_libraries(path, known) if owner not in found]
    return found


def identifier(*words):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.]+", "-", "-".join(words)).strip("-")


def document(packages, version, commit, epoch):
    """The text of the list for `packages`, kinds and paths: the same for the same packages."""
    known = contents()
    told = stanzas((ROOT / "Resources/package/copyright").read_text(encoding="utf-8"))
    listed, relations = {}, []
    for kind, path in packages:
        # The installer holds what the zip holds.
        where = dict(packages).get("zip") if kind == "setup" else path
        names = components_of(kind, path, known)
        if kind == "setup" and where:
            names += [name for name in components_of("zip", where, known) if name not in names]
        licences, copyrights = [], []
        own = identifier("package", path.name)
        for name in names:
            component = known["components"][name]
            if "stanza" in component:
                copyright_text, licence = told[component["stanza"]]
            else:
                copyright_text, licence = component["copyright"], component["licence"]
            licences.append(licence)
            copyrights.append(copyright_text)
            part = identifier("component", name)
            listed[part] = {
                "SPDXID": part, "name": component["name"], "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
                "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": copyright_text,
            }
            number = version_of(component, version, where)
            if number:
                listed[part]["versionInfo"] = number
            if "debian" in component:
                listed[part]["externalRefs"] = [{
                    "referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                    "referenceLocator": f"pkg:deb/debian/{component['debian'].replace('+', '%2B')}@{number}"}]
            relations.append((own, "CONTAINS", part))
        listed[own] = {
            "SPDXID": own, "name": "pacini", "versionInfo": version, "packageFileName": path.name,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "primaryPackagePurpose": PURPOSES[kind],
            "checksums": [{"algorithm": "SHA256", "checksumValue": hashlib.sha256(path.read_bytes()).hexdigest()}],
            "licenseConcluded": all_of(licences), "licenseDeclared": all_of(licences),
            "copyrightText": "\n".join(dict.fromkeys(copyrights)),
        }
        relations.append(("SPDXRef-DOCUMENT", "DESCRIBES", own))
    created = datetime.datetime.fromtimestamp(epoch, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    return json.dumps({
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"pacini-{version}",
        "documentNamespace": f"https://pacini.example/spdx/pacini-{version}-{commit}",
        "creationInfo": {"created": created,
                         "creators": ["Organization: The Pacini developers", "Tool: make_release.py"]},
        "packages": [listed[key] for key in sorted(listed)],
        "hasExtractedLicensingInfos": [{"licenseId": "LicenseRef-public-domain", "name": "public domain",
                                        "extractedText": PUBLIC_DOMAIN}],
        "relationships": [{"spdxElementId": of, "relationshipType": kind, "relatedSpdxElement": to}
                          for of, kind, to in sorted(set(relations))],
    }, indent=1, ensure_ascii=False) + "\n"
