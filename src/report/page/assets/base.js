"use strict";
// What every page needs: its data, elements, numbers as people read them.
const el = (id) => document.getElementById(id);
const data = JSON.parse(el("data").textContent);

// Elements are made by name, attributes and children; text is never markup.
function make(name, attributes, ...children) {
  const svg = ["svg", "g", "path", "line", "circle", "rect", "text", "title"].includes(name);
  const node = svg ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== false) node.setAttribute(key, value === true ? "" : value);
  }
  for (const child of children.flat()) if (child !== null && child !== undefined) node.append(child);
  return node;
}

// An array of numbers from "kind:base64".
function decode(text) {
  const raw = atob(text.slice(4));
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  const kinds = { "f32:": Float32Array, "u16:": Uint16Array, "u32:": Uint32Array, "i16:": Int16Array };
  return new kinds[text.slice(0, 4)](bytes.buffer);
}

// A few digits: 1.25, −0.5, 1.2e−9.
function short(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size < 1e-3 || size >= 1e6 ? Number(value.toPrecision(digits)).toExponential() : String(+value.toPrecision(digits));
  return text.replace("e+", "e").replace(/-/g, "−");
}

// With a prefix: 12.3 kN.
function withUnit(value, unit) {
  if (!Number.isFinite(value)) return short(value);
  const size = Math.abs(value);
  for (const [power, prefix] of [[1e9, "G"], [1e6, "M"], [1e3, "k"]]) if (size >= power && size < 1e12) return `${short(value / power)} ${prefix}${unit}`;
  return `${short(value)} ${unit}`;
}

const percent = (share) => (Number.isNaN(share) ? "–" : `${short(100 * share, 3)} %`);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
function rgb(name) {
  const hex = css(name).replace("#", "");
  const full = hex.length === 3 ? [...hex].map((c) => c + c).join("") : hex;
  return [0, 2, 4].map((k) => parseInt(full.slice(k, k + 2), 16) / 255);
}
