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
  const main = [["index.html", "contensou"], ...(ball ? [["explore.html", "Play"]] : []), ["gallery.html", "Gallery"], ["reference/index.html", "Reference"]];
  const values = { title: escape(title), root, version, body, main: main.map((each) => link(...each)).join("\n"), texts: list.join("\n") };
  write(path, template.replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]));
}

// The gallery: the pictures of portraits/README.md, each with the command and the words that stand above it.
function gallery() {
  const text = read("portraits/README.md");
  const shown = [...text.matchAll(/^`(contensou [^`]+)`\n\n([^`!]+?)\n\n!\[(.*)\]\((.+)\)$/gm)];
  if (shown.length !== text.match(/^!\[/gm).length) throw new Error("portraits/README.md: a picture stands below its command and its words, a paragraph each");
  const figures = shown.map(([, command, words, title, picture]) => {
    const [, width, height] = /viewBox="0 0 (\d+) (\d+)"/.exec(read(`portraits/${picture}`));
    return `<figure${width > 1.8 * height ? ' class="broad"' : ""}><a href="portraits/${picture}"><img src="portraits/${picture}" alt="${escape(title)}" width="${width}" height="${height}"></a>
<figcaption>${markdown.renderInline(words)}<pre tabindex="0"><code>${escape(command)}</code></pre></figcaption></figure>`;
  });
  page("gallery.html", "Gallery", `<h1>Gallery</h1>\n<p>Every picture is drawn by the command below it.</p>\n<div class="gallery">${figures.join("\n")}</div>`);
}

// The public headers, by doxygen; of its pages what lies between its own head and foot.
function reference() {
  const folder = mkdtempSync(join(tmpdir(), "contensou-reference-"));
  const roots = ["reduction", "portraits", "src"].map((part) => join(project, part, "include"));
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
<h2>Go on</h2>
<ul>
${ball ? '<li><a href="explore.html">Play</a>: change slip, spin, friction and patch; choose motions in the plane</li>' : ""}
<li><a href="gallery.html">Look</a>: the plane in eight views, each picture with its command</li>
<li><a href="README.html#run-it">Run it</a>: on your own machine, in the shell, in C++ or <a href="src/python/README.html">in Python</a></li>
<li><a href="reduction/README.html">Read</a>: the mathematics, with numbered equations, and where the paper errs</li>
<li><a href="src/fit/README.html">Measure</a>: friction and patch from a film of a ball</li>
<li><a href="src/site/cases/README.html">Compare</a>: ten motions as data, for the tests of physics engines</li>
<li><a href="reference/index.html">Look up</a>: every public header</li>
</ul>`);

if (ball) write("explore.html", readFileSync(ball, "utf8").replace("exactly.</p>", 'exactly. <a href="index.html">More about it</a></p>'));
write("style.css", readFileSync(join(here, "style.css")));
// Every browser reads woff2.
const typesetting = join(here, "node_modules/katex/dist");
cpSync(join(typesetting, "fonts"), join(out, "katex/fonts"), { recursive: true, filter: (path) => !/\.(woff|ttf)$/.test(path) });
write("katex/katex.css", readFileSync(join(typesetting, "katex.min.css"), "utf8").replace(/,url\([^)]*\) format\("(woff|truetype)"\)/g, ""));
