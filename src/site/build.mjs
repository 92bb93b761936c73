// Writes the project's texts, pictures and reference as a folder of web pages that asks the network for nothing:
//   node build.mjs PROJECT OUT DOXYGEN VERSION [PAGE]
// PAGE is the page of `contensou explore`. A link to a file that is not there is an error.
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, extname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import katex from "@vscode/markdown-it-katex";
import { slug } from "github-slugger";
import highlighter from "highlight.js";
import markdownIt from "markdown-it";
import anchor from "markdown-it-anchor";

const [project, out, doxygen, version, ball] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const template = readFileSync(join(here, "template.html"), "utf8");
const read = (path) => readFileSync(join(project, path), "utf8");
const escape = (text) => text.replace(/[&<>"]/g, (letter) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[letter]);

function write(path, content) {
  mkdirSync(dirname(join(out, path)), { recursive: true });
  writeFileSync(join(out, path), content);
}

// A text or a source becomes a page, a picture and data stay what they are. Some hosts serve no file whose name begins with a dot.
const isRaw = (path) => [".svg", ".png", ".csv", ".toml"].includes(extname(path));
const pageOf = (path) => (isRaw(path) ? path : `${path.replace(/\.md$/, "").replace(/(^|\/)\./g, "$1")}.html`);

function highlight(code, language) {
  const of = language === "python" && code.startsWith(">>>") ? "python-repl" : language;
  return highlighter.getLanguage(of) ? highlighter.highlight(code, { language: of }).value : escape(code);
}

const markdown = markdownIt({ highlight })
  .use(katex.default ?? katex, { throwOnError: true, strict: "error", enableFencedBlocks: true })
  .use(anchor, { slugify: slug, permalink: anchor.permalink.headerLink() });
// What is wider than a phone scrolls, by keys, too.
markdown.renderer.rules.table_open = () => '<div class="wide" role="group" aria-label="Table" tabindex="0"><table>';
markdown.renderer.rules.table_close = () => "</table></div>";
for (const kind of ["fence", "code_block"]) {
  const rule = markdown.renderer.rules[kind];
  markdown.renderer.rules[kind] = (...all) => rule(...all).replace("<pre", '<pre tabindex="0"');
}

const texts = new Map();   // those that links lead to, in the order of the links
const others = new Set();

// The path in the project that a link leads to, and its #part; of an address elsewhere, none.
function target(from, link) {
  if (/^[a-z]+:/.test(link)) return [];
  const [file, part = ""] = link.split("#");
  let path = file ? join(dirname(from), decodeURI(file)) : from;
  if (!existsSync(join(project, path))) throw new Error(`${from} links to ${link}, which is not there`);
  if (statSync(join(project, path)).isDirectory()) path = join(path, "README.md");
  return [path, part && `#${part}`];
}

function parse(path) {
  const env = {};
  const tokens = markdown.parse(read(path), env);
  for (const token of tokens.flatMap((each) => [each, ...(each.children ?? [])])) {
    const name = { link_open: "href", image: "src" }[token.type];
    if (!name || token.attrGet(name).startsWith("#")) continue;
    const [linked, part] = target(path, token.attrGet(name));
    if (!linked) continue;
    if (extname(linked) !== ".md") others.add(linked);
    else if (!texts.has(linked)) texts.set(linked, null);
    token.attrSet(name, relative(dirname(pageOf(path)), pageOf(linked)) + part);
  }
  const headings = tokens.flatMap((token, i) => (token.type === "heading_open" ? [{ level: token.tag, id: token.attrGet("id"), title: plain(tokens[i + 1]) }] : []));
  texts.set(path, { tokens, env, headings, title: headings[0].title });
}
const plain = (token) => token.children.map((each) => (["text", "code_inline"].includes(each.type) ? each.content : "")).join("");
const html = (tokens, env) => markdown.renderer.render(tokens, markdown.options, env).replaceAll("<th></th>", "<td></td>")
  .replaceAll('<span class="katex-display">', '<span class="katex-display" role="group" aria-label="Formula" tabindex="0">');

function page(path, title, body) {
  const root = relative(dirname(path), ".") || ".";
  const link = (to, text) => `<a href="${root}/${to}"${to === path ? ' aria-current="page"' : ""}>${escape(text)}</a>`;
  const list = [...texts].map(([text, { title, headings }]) => {
    const to = pageOf(text);
    const parts = headings.filter(({ level }) => level === "h2" && (to === path || (path === "index.html" && to === "README.html")))
      .map(({ id, title }) => `<li><a href="${root}/${to}#${id}">${escape(title)}</a></li>`);
    return `<li>${link(to, to === "README.html" ? "README" : title)}${parts.length ? `<ul>${parts.join("")}</ul>` : ""}</li>`;
  });
  const main = [["index.html", "contensou"], ...(ball ? [["explore.html", "Play"]] : []), ...readers.map(({ path, title }) => [path, title]), ["reference/index.html", "Reference"]];
  const values = { title: escape(title), root, version, body, main: main.map((each) => link(...each)).join("\n"), texts: list.join("\n") };
  write(path, template.replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]));
}

// Width and height of a picture of the project, and the picture at its own size, a link to it.
function sizeOf(picture) {
  const bytes = readFileSync(join(project, picture));
  return picture.endsWith(".png") ? [bytes.readUInt32BE(16), bytes.readUInt32BE(20)] : /viewBox="0 0 (\d+) (\d+)"/.exec(bytes.toString()).slice(1).map(Number);
}
function linkedPicture(picture, title, to = picture) {
  const [width, height] = sizeOf(picture);
  others.add(picture);
  return `<a href="${to}"><img src="${picture}" alt="${escape(title)}" width="${width}" height="${height}"></a>`;
}

// The pictures of portraits/README.md, each with the command and the words that stand above it.
function shownPictures() {
  const text = read("portraits/README.md");
  const shown = [...text.matchAll(/^`(contensou [^`]+)`\n\n([^`!]+?)\n\n!\[(.*)\]\((.+)\)$/gm)];
  if (shown.length !== text.match(/^!\[/gm).length) throw new Error("portraits/README.md: a picture stands below its command and its words, a paragraph each");
  return shown.map(([, command, words, title, picture]) => ({ command, words, title, picture: `portraits/${picture}` }));
}

function gallery() {
  const figures = shownPictures().map(({ command, words, title, picture }) => {
    const [width, height] = sizeOf(picture);
    return `<figure${width > 1.8 * height ? ' class="broad"' : ""}>${linkedPicture(picture, title)}
<figcaption>${markdown.renderInline(words)}<pre tabindex="0"><code>${escape(command)}</code></pre></figcaption></figure>`;
  });
  page("gallery.html", "Gallery", `<h1>Gallery</h1>\n<p>Every picture is drawn by the command below it.</p>\n<div class="gallery">${figures.join("\n")}</div>`);
}

// A page for each sort of reader: a command, its picture, what README says of it, and where to go on.
const readers = [
  { path: "start.html", title: "First ten minutes", words: "On a fresh Debian 12 this command builds the program, prints when a pool ball stops, and draws the plane of all its motions.",
    command: "bash .ci/demo", picture: "portraits/pool.svg", alt: "Phase portrait of a pool ball", parts: ["#quick-start"],
    links: [["src/program/README.md", "A command for each purpose"], [".github/INSTALL.md", "Installation"], ["src/site/field.md", "Other tools"]] },
  { path: "draw.html", title: "Draw", gallery: "uv.svg", parts: ["#draw"],
    links: [["src/program/README.md#draw", "Commands for pictures"], ["gallery.html", "Gallery: every picture with its command"], ["portraits/README.md", "How a portrait is made"]] },
  { path: "compute.html", title: "Compute", gallery: "roll.svg", parts: ["#compute", "#accuracy-and-speed"],
    links: [["src/program/README.md", "A command for each purpose"], ["src/javascript/README.md", "In JavaScript"]] },
  { path: "check.html", title: "Check", gallery: "reduction.svg", parts: ["#check"],
    links: [["src/program/README.md#check", "Commands for checks"], ["reduction/theory.md#errata-of-the-paper", "Errors of the paper"], ["tests/README.md", "The tests"]] },
  { path: "python.html", title: "Python", words: "The Python module works with NumPy's arrays. matplotlib draws this plane of a puck.", picture: "src/python/notebook/plane.png",
    command: 'import contensou as ct\nct.portrait(body="disc").plot()', language: "python", alt: "The plane of a puck", parts: ["In Python,"],
    links: [["src/python/README.md", "The tour"], ["src/python/notebook/README.md", "Why a spinning ball slides farther: a lesson as a notebook"]] },
  { path: "engines.html", title: "Engines", words: "The first command prints the numbers to type into an engine; there are eighteen engines. The curves show force against moment. An engine uses the ellipse, the chord, or a separate limit for each.",
    command: "contensou engine mujoco --ball pool\ncontensou law --surface -o surface.svg", picture: "portraits/gallery/surface.svg", alt: "Limit surfaces", parts: [],
    links: [["src/si/README.md#torsional-friction-in-an-engine", "Torsional friction in an engine"], ["src/si/README.md#the-wrench-in-c", "The wrench in C"], ["src/site/cases/README.md", "Ten motions as data for the tests of an engine"]] },
  { path: "film.html", title: "Film", words: "The command finds friction and patch radius from a film, with intervals. The picture shows a real slide beside the exact motion and the uncoupled model.",
    command: "contensou fit hit10.csv --fps 360 --ball cylinder.toml --law uniform -o film.png", picture: "src/fit/film.png", alt: "A cylinder that slides and turns: measured, exact, textbook", parts: [],
    links: [["src/fit/README.md#how-to-film-it", "How to film it"], ["src/fit/README.md#real-films", "Two real slides"], ["src/fit/README.md#the-estimate", "The estimate"]] },
  { path: "mathematics.html", title: "Mathematics", gallery: "similarity.svg", parts: [],
    links: ["theory.md", "theory.md#the-plane-at-the-origin-and-at-infinity", "theory.md#a-constant-drive", "theory.md#errata-of-the-paper", "planar.md", "numerics.md#proofs", "numerics.md#laws", "numerics.md#numerics", "glossary.md"].map((id) => [`reduction/${id}`]) },
];

// Of README: the section of "#id"; or the paragraph that begins so, with the block of code below it.
function partOfReadme(part) {
  const { tokens, env } = texts.get("README.md");
  const starts = (token, i) => (part.startsWith("#") ? token.type === "heading_open" && token.attrGet("id") === part.slice(1)
    : token.type === "paragraph_open" && tokens[i + 1].content.startsWith(part));
  const first = tokens.findIndex(starts);
  if (first < 0) throw new Error(`README.md has no ${part}`);
  const next = part.startsWith("#") ? tokens.findIndex(({ type, tag }, i) => i > first && type === "heading_open" && tag === "h2") : first + 3;
  const end = next < 0 ? tokens.length : next;
  return html(tokens.slice(first, end + (!part.startsWith("#") && ["fence", "code_block"].includes(tokens[end]?.type) ? 1 : 0)), env);
}

function reader({ path, title, gallery, parts, links, language = "bash", ...given }) {
  const { command, words, picture, alt } = gallery ? (({ title, ...shown }) => ({ ...shown, alt: title }))(shownPictures().find((each) => each.picture.endsWith(`/${gallery}`))) : given;
  const list = links.map(([to, text]) => {
    const [file, part] = to.split("#");
    const heading = part && texts.get(file).headings.find(({ id }) => id === part);
    if (part && !heading) throw new Error(`${path} leads to ${to}, which is not there`);
    return `<li><a href="${texts.has(file) ? pageOf(file) : file}${part ? `#${part}` : ""}">${escape(text ?? (heading ?? texts.get(file)).title)}</a></li>`;
  });
  page(path, title, `<h1>${escape(title)}</h1>
<pre tabindex="0"><code>${highlight(command, language)}</code></pre>
<figure class="first">${linkedPicture(picture, alt)}<figcaption>${markdown.renderInline(words)}</figcaption></figure>
${parts.map(partOfReadme).join("\n")}
<h2>Go on</h2>
<ul>${list.join("\n")}</ul>`);
  return `<figure>${linkedPicture(picture, alt, path)}<figcaption><a href="${path}">${escape(title)}</a></figcaption></figure>`;
}

// The public headers, by doxygen; of its pages what lies between its own head and foot.
function reference() {
  const folder = mkdtempSync(join(tmpdir(), "contensou-reference-"));
  const roots = ["reduction", "portraits", "src/si", "src/fit"].map((part) => join(project, part, "include"));
  const quoted = (...paths) => paths.map((path) => `"${path}"`).join(" ");
  const headers = roots.flatMap((root) => readdirSync(root, { recursive: true }).filter((path) => /\.hp*$/.test(path)).sort());
  // A page for each header, too.
  const contents = headers.map((path) => `- @ref ${path}`).join("\n");
  writeFileSync(join(folder, "headers.dox"), `/**\n${headers.map((path) => `@file ${path}\n`).join("*//**")}*/\n/** @page headers Headers\n${contents}\n*/\n`);
  const settings = [readFileSync(join(here, "Doxyfile"), "utf8"), `OUTPUT_DIRECTORY = ${quoted(folder)}`, `STRIP_FROM_PATH = ${quoted(...roots)}`,
    `STRIP_FROM_INC_PATH = ${quoted(...roots)}`, `INPUT = ${quoted(...roots, join(here, "reference.dox"), join(folder, "headers.dox"))}`];
  execFileSync(doxygen, ["-"], { input: settings.join("\n"), stdio: ["pipe", "inherit", "inherit"] });

  const unused = /^(annotated|classes|concepts|dir_.*|files|functions.*|globals.*|hierarchy|inherits|namespaces|namespacemembers.*|pages|.*-members)\.html$/;
  const pages = readdirSync(join(folder, "html")).filter((file) => file.endsWith(".html") && !unused.test(file))
    .map((file) => [file, readFileSync(join(folder, "html", file), "utf8")]);
  rmSync(folder, { recursive: true });
  const declared = new Map();   // where: functions and types of a namespace do not say it themselves
  for (const [file, text] of pages.filter(([file]) => /_8hp*\.html$/.test(file)))
    for (const [, name] of text.matchAll(/href="(namespace[^"]*#a[0-9a-f]+)"/g)) declared.set(name, [file, /<title>contensou: (\S+)/.exec(text)[1]]);

  for (const [file, text] of pages) {
    const body = text.slice(text.indexOf('<div class="header">'), text.indexOf("<!-- contents -->"))
      .replace(/<div class="title">(.*)<\/div><\/div>/, "<h1>$1</h1></div>")
      .replaceAll('<pre class="fragment">', '<pre tabindex="0">')
      .replaceAll('<div class="fragment">', '<div class="fragment" role="group" aria-label="Source" tabindex="0">')
      .replace(/<hr\/>The documentation for this[^]*?<\/ul>/, "")
      .replace(/ onclick="[^"]*"><img src="closed.png" alt="-"\/>/g, ">")
      .replace(/<a id="(a[0-9a-f]+)" name="\1"><\/a>/g, (anchor, id) => {
        const [header, path] = declared.get(`${file}#${id}`) ?? [];
        return header ? `${anchor}<a class="declared" href="${header}">${path}</a>` : anchor;
      })
      .replace(/<a href="#[^"]*">[^<]*<\/a>( &#124;)?\s*|<a href="[^"]*-members.html">[^<]*<\/a>/g, "");
    page(`reference/${file}`, /<title>contensou: (.*)<\/title>/.exec(text)[1], `<div class="reference">${body}</div>`);
  }
}

rmSync(out, { recursive: true, force: true });
for (const first of ["README.md", ".github/CONTRIBUTING.md", ".github/CHANGELOG.md"]) {
  texts.set(first, texts.get(first));
  for (const [path, text] of texts) if (!text) parse(path);   // which adds to texts
}
const readme = texts.get("README.md");
for (const [path, { tokens, env, title }] of texts) page(pageOf(path), title, html(tokens, env));
// The lesson as a file for programs of notebooks.
const lesson = "src/python/notebook/lesson.ipynb";
mkdirSync(dirname(join(out, lesson)), { recursive: true });
execFileSync("python3", [join(project, "src/python/notebook/notebook.py"), "build", join(out, lesson)]);
readers.find(({ title }) => title === "Python").links.push([lesson, "The lesson as a file, lesson.ipynb"]);
const cards = readers.map(reader);
for (const path of others) {
  const language = path.startsWith(".ci/") ? "bash" : extname(path).slice(1);
  if (isRaw(path)) write(path, readFileSync(join(project, path)));
  else page(pageOf(path), path, `<h1>${path}</h1><pre tabindex="0"><code>${highlight(read(path), language)}</code></pre>`);
}
gallery();
reference();

// README up to its second heading, below the ball.
const second = readme.tokens.findIndex(({ tag }) => tag === "h2");
const first = ball ? '<iframe src="explore.html#embed" title="Two equal pucks leave equally fast; one of them spins"></iframe>'
  : "<p><em>Built without the page of <code>contensou explore</code>: <code>-DCONTENSOU_PAGE=ON</code> adds it.</em></p>";
const [heading, rest] = [readme.tokens.slice(0, 3), readme.tokens.slice(3, second)].map((tokens) => html(tokens, readme.env));
page("index.html", "contensou: a ball that slides and spins", `${heading}${first}${rest}
<h2>What brings you here?</h2>
${ball ? '<p><a href="explore.html">Play</a>: change slip, spin, friction and patch; choose motions in the plane. Or:</p>' : ""}
<div class="cards">${cards.join("\n")}</div>
<p>Every picture is in the <a href="gallery.html">gallery</a>, every public header in the <a href="reference/index.html">reference</a>.</p>`);

if (ball) write("explore.html", readFileSync(ball, "utf8").replace("exactly.</p>", 'exactly. <a href="index.html">More about it</a></p>'));
write("style.css", readFileSync(join(here, "style.css")));
// Every browser reads woff2.
const typesetting = join(here, "node_modules/katex/dist");
cpSync(join(typesetting, "fonts"), join(out, "katex/fonts"), { recursive: true, filter: (path) => !/\.(woff|ttf)$/.test(path) });
write("katex/katex.css", readFileSync(join(typesetting, "katex.min.css"), "utf8").replace(/,url\([^)]*\) format\("(woff|truetype)"\)/g, ""));
