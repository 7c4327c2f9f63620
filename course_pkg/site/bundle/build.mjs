/* Builds the files that the pages load. `npm ci && npm run build` writes them to ./out. */
import { build } from "esbuild";
import { copyFile, mkdir, readFile, writeFile } from "node:fs/promises";

const FONTS = [
  { family: "Course Sans", file: "source-sans-3/files/source-sans-3-latin-wght-normal.woff2", style: "normal", weight: "200 900" },
  { family: "Course Sans", file: "source-sans-3/files/source-sans-3-latin-wght-italic.woff2", style: "italic", weight: "200 900" },
  { family: "Course Code", file: "source-code-pro/files/source-code-pro-latin-wght-normal.woff2", style: "normal", weight: "200 900" },
];
const PACKAGES = ["minisearch", "@fontsource-variable/source-sans-3", "@fontsource-variable/source-code-pro"];
const settings = { bundle: true, minify: true, format: "iife", target: "es2021", charset: "utf8", legalComments: "none" };

await mkdir("out", { recursive: true });
await build({ ...settings, entryPoints: ["src/site.js"], outfile: "out/site.js" });
await build({ ...settings, entryPoints: ["src/early.js"], outfile: "out/early.js" });
await writeFile("out/fonts.css", (await Promise.all(FONTS.map(face))).join(""));
await writeFile("out/LICENSES.txt", (await Promise.all(PACKAGES.map(licence))).join("\n\n"));
await copyFile("node_modules/axe-core/axe.min.js", "out/axe.min.js");

/* Returns the CSS of a font face with the font's data, because a page from a local folder cannot load a
   font file. */
async function face({ family, file, style, weight }) {
  const data = (await readFile(`node_modules/@fontsource-variable/${file}`)).toString("base64");
  return `@font-face{font-family:"${family}";font-style:${style};font-weight:${weight};font-display:block;src:url(data:font/woff2;base64,${data}) format("woff2")}\n`;
}

async function licence(name) {
  const about = JSON.parse(await readFile(`node_modules/${name}/package.json`, "utf8"));
  const text = await readFile(`node_modules/${name}/LICENSE`, "utf8").catch(() => readFile(`node_modules/${name}/LICENSE.txt`, "utf8"));
  const rule = "=".repeat(78);
  return `${rule}\n${name} ${about.version}: ${about.license}\n${rule}\n\n${text.trim()}\n`;
}
