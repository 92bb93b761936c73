"""Letters and lines are as large in every picture format as the layout wants them: read back from the files of every
verb that draws.

python3 pictures.py PROGRAM
"""

import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib

PT = 72 / 25.4  # to the millimetre
LETTER = (2.0 + 0.0041 * 85) * PT  # in a column of 85 mm, as layout.cpp has it
TITLE = 1.2 * LETTER
VERBS = {
    "portrait": "portrait --mu 0.3",
    "portrait of a ball": "portrait --ball pool --view similarity",
    "law": "law",
    "surface": "law --surface",
    "roll": "roll --ball pool --velocity 1,0 --angular-velocity 40,35,-50",
    "sweep": "sweep --mu 0.1 --u0 0:2:9 --v0 0.01:2:9",
    "fit": "fit {film} --ball pool",
}


def page_of(name):
    """What cairo drew on the page of a PDF or an EPS: its operators."""
    with open(name, "rb") as file:
        content = file.read()
    if name.endswith(".eps"):
        return content
    streams = re.findall(rb"stream\r?\n(.*?)endstream", content, re.S)
    unpacked = [zlib.decompressobj().decompress(stream) for stream in streams if stream[:1] == b"\x78"]
    return b"".join(stream for stream in unpacked if b" Tm" in stream)


def sizes_and_widths(name):
    """Sizes of the letters and widths of the lines in a file, in pt, from small to large."""
    if name.endswith(".svg"):
        with open(name, "rb") as file:
            content = file.read()
        unit = PT * float(re.search(rb'width="(\d+)mm', content)[1]) / float(re.search(rb'viewBox="0 0 (\d+) ', content)[1])
        sizes = [unit * float(size) for size in re.findall(rb'font-size="([\d.]+)"', content)]
        widths = [unit * float(width) for width in re.findall(rb'stroke-width="([\d.]+)"', content)]
    else:
        content = page_of(name)
        matrices = re.findall(rb"([-\d.]+) ([-\d.]+) [-\d.]+ [-\d.]+ [-\d.]+ [-\d.]+ Tm", content)
        sizes = [float(a) or abs(float(b)) for a, b in matrices]
        widths = [float(width) for width in re.findall(rb"([\d.]+) w\s", content)]
    return sorted(sizes), sorted(widths)


def top_letters(name):
    """The height of what stands alone on top of a PNG, in the middle of its width, in pt."""
    with open(name, "rb") as file:
        content = file.read()
    width, height, bits, kind = struct.unpack(">IIBB", content[16:26])
    assert bits == 8 and kind in (2, 6), (bits, kind)
    data, at = b"", 8
    while at < len(content):
        length, chunk = struct.unpack(">I4s", content[at : at + 8])
        if chunk == b"IDAT":
            data += content[at + 8 : at + 8 + length]
        at += 12 + length
    data = zlib.decompress(data)
    pixel = 3 if kind == 2 else 4
    stride = width * pixel
    before, top = bytearray(stride), None
    for y in range(height):
        line = bytearray(data[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        filtered = data[y * (stride + 1)]
        for i in range(stride) if filtered else ():
            left, up, corner = (line[i - pixel], before[i], before[i - pixel]) if i >= pixel else (0, before[i], 0)
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda one: abs(guess - one))
            line[i] = (line[i] + (0, left, up, (left + up) // 2, paeth)[filtered]) & 255
        before = line
        dark = min(line[4 * width // 10 * pixel : 6 * width // 10 * pixel : pixel]) < 128
        if dark and top is None:
            top = y
        if top is not None and not dark:
            return (y - top) / width * 85 * PT
    return 0


def check(what, wanted, found, tolerance=0.02):
    """Ends the test where a size is off by more than so many parts of it."""
    if abs(found - wanted) > tolerance * wanted:
        sys.exit(f"{what} of {found:.2f} pt, {wanted:.2f} pt are wanted")


def check_lines(what, svg, widths):
    """Every line of PDF and EPS is as wide as one of SVG."""
    for width in widths:
        check(f"{what}: a line", min(svg, key=lambda one: abs(one - width)), width, 0.04)


def main(program):
    def run(*words):
        subprocess.run([program, *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    with tempfile.TemporaryDirectory() as folder:
        film = os.path.join(folder, "film.csv")
        run(*"roll --ball pool --velocity 1,0 --angular-velocity 0,0,60 --samples 30 -o".split(), film)
        for verb, words in VERBS.items():
            arguments = words.format(film=film).split() + ["--size", "single", "--title", "H", "-o"]
            pictures = {ending: os.path.join(folder, "picture." + ending) for ending in ("svg", "pdf", "eps", "png")}
            for name in pictures.values():
                run(*arguments, name)
            svg, svg_widths = sizes_and_widths(pictures["svg"])
            check(f"{verb}, svg: a title", TITLE, svg[-1])
            for ending in ("pdf", "eps"):
                letters, widths = sizes_and_widths(pictures[ending])
                check(f"{verb}, {ending}: a title", TITLE, letters[-1])
                check(f"{verb}, {ending}: smallest letters", svg[0], letters[0])
                check_lines(f"{verb}, {ending}", svg_widths, widths)
            # Capitals of sans-serif fonts have 0.65 to 0.75 of the size of letters.
            check(f"{verb}, png: a title", 0.7 * TITLE, top_letters(pictures["png"]), 0.1)
        run("paper", "--size", "single", "--out", folder)
        for number in "1234":
            svg, pdf = (sizes_and_widths(os.path.join(folder, f"fig{number}.{ending}")) for ending in ("svg", "pdf"))
            for i in (0, -1):
                check(f"paper, fig{number}.pdf: letters", svg[0][i], pdf[0][i])
            check_lines(f"paper, fig{number}.pdf", svg[1], pdf[1])


main(sys.argv[1])
