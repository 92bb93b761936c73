"""Links between the documents lead to a file, and #parts to a heading in it. Paths in the text name a file, too.

    links_test.py TOP [DOCUMENTS]

DOCUMENTS  least number of documents below TOP, default 20
"""

import pathlib
import re
import sys

TOP = pathlib.Path(sys.argv[1]).resolve()
LEAST = int(sys.argv[2]) if len(sys.argv) > 2 else 20
LEFT_OUT = {"build", "node_modules"}


def prose(path):
    """The text without blocks of code."""
    return re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.S | re.M)


def parts(path):
    """Addresses of the headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", prose(path), re.M)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"\]\([^)]*\)", "", heading).lower()).replace(" ", "-") for heading in headings}


documents = [path for path in TOP.rglob("*.md") if not LEFT_OUT & set(path.relative_to(TOP).parts)]
count, faults = 0, []
for document in documents:
    for link in re.findall(r"\]\(([^)\s]+)\)", prose(document)):
        if re.match(r"[a-z]+:", link):
            continue
        count += 1
        file, _, part = link.partition("#")
        target = (document.parent / file).resolve() if file else document
        if target.is_dir():
            target /= "README.md"
        if not target.exists() or part and part not in parts(target):
            faults.append(f"{document.relative_to(TOP)}: {link}")
    for path in re.findall(r"(?<![\w/.])(?:src|tests|reduction|portraits|\.ci)/[\w/.-]+\.\w+", document.read_text(encoding="utf-8")):
        if "NAME" not in path and not (TOP / path).exists() and (TOP / "src").exists():
            faults.append(f"{document.relative_to(TOP)}: {path}")
assert len(documents) >= LEAST and count >= 5 * LEAST, (len(documents), count)
print(f"{count} links of {len(documents)} documents")
sys.exit("\n".join(faults) or 0)
