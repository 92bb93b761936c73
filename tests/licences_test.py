"""The licences of other people's libraries, in .github/THIRD_PARTY.txt.

python3 licences_test.py ROOT            every library that a source includes has an entry, and each licence its text
python3 licences_test.py ROOT ARTEFACTS  each file of a release in this folder contains the licences of the libraries inside it
"""

import io
import re
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

root = Path(sys.argv[1])
licence = (root / "LICENSE").read_text()
listed = (root / ".github/THIRD_PARTY.txt").read_text()

LIBRARIES = {  # the beginning of an #include, and its entry
    "boost/": "Boost", "CLI/": "CLI11", "Eigen/": "Eigen", "unsupported/Eigen/NonLinearOptimization": "MINPACK, in Eigen",
    "fmt/": "fmt", "gnuplot-iostream.h": "gnuplot-iostream", "nlohmann/": "nlohmann-json", "pybind11/": "pybind11",
    "range/v3/": "range-v3", "toml++/": "toml++", "emscripten/": "Emscripten",
}
OURS_OR_THE_SYSTEMS = re.compile(r"contensou/|sys/|[a-z0-9_]+(\.h)?$")
# Licences whose only conditions for a page are satisfied by their address.
ADDRESSES = {"Apache-2.0 WITH LLVM-exception": "apache.org/licenses/LICENSE-2.0", "MPL-2.0": "mozilla.org/MPL/2.0"}
ARTEFACTS = {  # a file of a release, and its kinds, in the words of "Inside" in THIRD_PARTY.txt
    "contensou_*.deb": {"program", "page"}, "libcontensou-dev_*.deb": {"program"}, "python3-contensou_*.deb": {"python"},
    "contensou-*.zip": {"program", "Windows", "page"}, "contensou-*.whl": {"python"}, "contensou-*.tgz": {"page"},
    "page.html": {"page"}, "contensou-*.tar.gz": {"sources"},
}

head, *sections = re.split(r"={78}\n(.*)\n={78}\n", listed)
texts = dict(zip(sections[::2], sections[1::2]))
entries = {name: (licences.split(" and "), set(inside.split(", "))) for name, licences, inside in re.findall(
    r"^(\S.*)\n  Source: .*\n  Licence:   (.*)\n  Inside:    (.*)\n  Copyright ", head, re.MULTILINE)}


def squeeze(text):
    return " ".join(text.split())


def faults_of_sources():
    for folder in ("reduction", "portraits", "src"):
        for file in sorted((root / folder).rglob("*.[ch]pp")):
            if "node_modules" in file.parts:
                continue
            for include in re.findall(r"^\s*#\s*include <(.*)>", file.read_text(), re.MULTILINE):
                found = next((name for start, name in LIBRARIES.items() if include.startswith(start)), None)
                if found is None and not OURS_OR_THE_SYSTEMS.match(include):
                    yield f"{file.relative_to(root)}: <{include}> belongs to no library of this test"
                elif found is not None and found not in entries:
                    yield f"{file.relative_to(root)}: <{include}>: THIRD_PARTY.txt has no entry {found}"
    for file in sorted(root.glob("src/page/*/*.js")):
        for name in re.findall(r"^/\*! (\S+) ", file.read_text(), re.MULTILINE):
            if name not in entries:
                yield f"{file.relative_to(root)}: THIRD_PARTY.txt has no entry {name}"
    for name, (licences, _) in entries.items():
        for each in licences:
            if len(texts.get(each, "")) < 900:
                yield f"THIRD_PARTY.txt: {name}: the text of {each} is missing"


def files_of(artefact):
    """Returns the texts inside an archive, by name."""
    if artefact.suffix in (".whl", ".zip"):
        with zipfile.ZipFile(artefact) as archive:
            return {name: archive.read(name).decode(errors="replace") for name in archive.namelist()}
    data = artefact.read_bytes()
    if artefact.suffix == ".deb":
        data = subprocess.run(["dpkg-deb", "--fsys-tarfile", artefact], stdout=subprocess.PIPE, check=True).stdout
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        return {each.name: archive.extractfile(each).read().decode(errors="replace") for each in archive if each.isfile()}


def faults_of_artefact(artefact, kinds):
    inside = {name: licences for name, (licences, kept) in entries.items() if kept & kinds}
    if artefact.suffix == ".html":
        text = squeeze(artefact.read_text())
        for wanted in [licence, *(ADDRESSES.get(each) or texts.get(each, f"the text of {each}") for each in sum(inside.values(), []))]:
            if squeeze(wanted) not in text:
                yield f"{artefact.name} lacks: {squeeze(wanted)[:60]}..."
        for name in inside:
            if f" {name} Source: " not in text:
                yield f"{artefact.name} does not name {name}"
        return
    files = files_of(artefact)
    own = squeeze(licence.split("\n\n", 2)[2])
    if not any(own in squeeze(text.replace("\n .\n", "\n")) for name, text in files.items() if name.endswith(("LICENSE", "copyright"))):
        yield f"{artefact.name} lacks the licence of contensou"
    if listed not in [text for name, text in files.items() if name.endswith("THIRD_PARTY.txt")]:
        yield f"{artefact.name} lacks THIRD_PARTY.txt"
    print(f"{artefact.name}: {'; '.join(inside) or 'no library'}")


faults = list(faults_of_sources())
for pattern, kinds in ARTEFACTS.items() if len(sys.argv) > 2 else ():
    found = [each for each in Path(sys.argv[2]).glob(pattern)]
    if len(found) != 1:
        faults.append(f"{len(found)} files are called {pattern}")
    for each in found:
        faults.extend(faults_of_artefact(each, kinds))
for fault in faults:
    print(fault)
sys.exit(1 if faults else 0)
