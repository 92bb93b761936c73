"""README.md beside this as a notebook, and back.

    python3 notebook.py build OUT.ipynb          the text as a notebook
    python3 notebook.py compare EXECUTED.ipynb   whether its outputs are those of the text; status 1 if not
    python3 notebook.py update EXECUTED.ipynb    takes outputs and pictures into the text

A block of python is a cell. A block of text right below it is what it prints, a picture there is what it draws.
"""

import base64
import io
import json
import pathlib
import re
import sys

text_file = pathlib.Path(__file__).with_name("README.md")
cell = re.compile(r"^```python\n(?P<code>.*?)^```\n(?:\n```text\n(?P<printed>.*?)^```\n)?(?:\n!\[[^\n]*\]\((?P<picture>[^\n]*)\)\n)?",
                  re.M | re.S)


def notebook(text):
    cells = []

    def add(kind, source, **more):
        if source.strip():
            cells.append({"id": f"cell-{len(cells)}", "cell_type": kind, "metadata": {}, "source": source.strip(), **more})

    end = 0
    for found in cell.finditer(text):
        add("markdown", text[end:found.start()])
        add("code", found["code"], execution_count=None, outputs=[])
        end = found.end()
    add("markdown", text[end:])
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}


def outputs_of(executed):
    """Yields the printed text and the pictures of each code cell."""
    for each in executed["cells"]:
        if each["cell_type"] == "code":
            printed = "".join("".join(output["text"]) for output in each["outputs"] if output["output_type"] == "stream")
            pictures = [output["data"]["image/png"] for output in each["outputs"] if "image/png" in output.get("data", {})]
            yield printed, pictures


def main(verb, file):
    text = text_file.read_text()
    if verb == "build":
        pathlib.Path(file).write_text(json.dumps(notebook(text), indent=1, ensure_ascii=False) + "\n")
        return 0
    if verb == "update":
        import PIL.Image
    status = 0
    parts, end = [], 0
    for found, (printed, pictures) in zip(cell.finditer(text), outputs_of(json.loads(pathlib.Path(file).read_text())), strict=True):
        first = found["code"].split("\n", 1)[0]
        if len(pictures) != (found["picture"] is not None):
            raise SystemExit(f"the cell '{first} ...' draws {len(pictures)} pictures")
        if (found["printed"] is not None) != bool(printed):
            raise SystemExit(f"the cell '{first} ...' prints {printed!r}")
        if verb == "compare":
            if printed != (found["printed"] or ""):
                print(f"the cell '{first} ...' printed\n{printed}in place of\n{found['printed']}")
                status = 1
            continue
        for picture in pictures:
            drawn = PIL.Image.open(io.BytesIO(base64.b64decode(picture))).convert("RGB")
            drawn.quantize(96).save(text_file.with_name(found["picture"]), optimize=True)
        at = found.span("printed")
        if printed:
            parts += [text[end:at[0]], printed]
            end = at[1]
    if verb == "update":
        text_file.write_text("".join(parts) + text[end:])
    return status


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("build", "compare", "update"):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
