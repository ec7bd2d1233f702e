"use strict";
(function () {
  const AT_ONCE = 100; // A click lays the whole table out again, so its time grows with the rows that are shown.
  const SVG = "http://www.w3.org/2000/svg";
  const PANELS = [
    {name: "fy", title: "Lateral force", x: "slip angle (deg)", y: "Fy (kN)", across: 180 / Math.PI, scale: 1e-3,
     see: "The slope at zero is the cornering stiffness, the largest force over the load is the friction."},
    {name: "fx", title: "Longitudinal force", x: "slip ratio", y: "Fx (kN)", across: 1, scale: 1e-3,
     see: "The slope at zero is the slip stiffness, the largest force over the load is the friction."},
    {name: "mz", title: "Aligning moment", x: "slip angle (deg)", y: "Mz (N m)", across: 180 / Math.PI, scale: 1,
     see: "The slope at zero is the cornering stiffness times the pneumatic trail."},
  ];
  const data = JSON.parse(document.getElementById("data").textContent);
  const at = Object.fromEntries(data.columns.map((name, i) => [name, i]));
  const body = document.querySelector("#files tbody");
  const field = name => document.getElementById(name);
  let rows = [], shown = [], first = 0, sort = null, falling = false;
  const opened = new Map();

  async function unpack(text) {
    const bytes = Uint8Array.from(atob(text), each => each.charCodeAt(0));
    const stream = new DecompressionStream("deflate"), writer = stream.writable.getWriter();
    const written = Promise.all([writer.write(bytes), writer.close()]); // a Blob would go through another process
    const reader = stream.readable.getReader(), pieces = [];
    for (let each = await reader.read(); !each.done; each = await reader.read()) pieces.push(each.value);
    await written;
    const whole = new Uint8Array(pieces.reduce((size, each) => size + each.length, 0));
    let place = 0;
    for (const each of pieces) { whole.set(each, place); place += each.length; }
    return whole;
  }
  async function unpackJson(text) {
    return JSON.parse(new TextDecoder().decode(await unpack(text)));
  }
  function element(name, text, className) {
    const made = document.createElement(name);
    if (text !== undefined) made.textContent = text;
    if (className) made.className = className;
    return made;
  }
  function drawn(name, attributes, text) {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    return made;
  }
  function number(value) {
    return value === null ? "–" : value.toFixed(value < 10 ? 2 : 0);
  }
  function counted(value) {
    return value.toLocaleString("en");
  }
  function percent(value) {
    return value === null ? "–" : Math.round(100 * value) + "%";
  }

  // The list -------------------------------------------------------------------------------------------
  function choose() {
    const words = field("search").value.toLowerCase().split(/\s+/).filter(Boolean);
    const supplier = field("supplier").value, verdict = field("verdict").value;
    const noted = field("noted").value;
    const tire = field("tire").value.trim().toLowerCase(), whose = field("whose").value;
    shown = rows.filter(row =>
      (!supplier || row.cells[at.supplier] === supplier) &&
      (!verdict || row.cells[at.verdict] === verdict) &&
      (!tire || row.cells[at.tire].toLowerCase().includes(tire)) &&
      (!whose || row.cells[at.own] === (whose === "own")) &&
      (!noted || row.cells[at.noted] > 0 === (noted === "some")) &&
      words.every(word => row.text.includes(word)));
    if (sort) {
      const key = at[sort], sign = falling ? -1 : 1;
      shown.sort((a, b) => {
        const x = a.cells[key], y = b.cells[key];
        if (x === null || y === null) return (x === null) - (y === null);
        if (x === y) return a.index - b.index;
        return sign * (typeof x === "number" ? x - y : x.localeCompare(y, "en", {numeric: true}));
      });
    }
    turn(0);
  }
  function turn(to) {
    first = to;
    fill();
  }
  function fill() {
    const list = document.createDocumentFragment();
    const end = Math.min(first + AT_ONCE, shown.length);
    for (const row of shown.slice(first, end)) {
      list.append(line(row));
      if (row.detail) list.append(row.detail);
    }
    body.replaceChildren(list);
    const all = shown.length === rows.length ? counted(rows.length) + " files" : counted(shown.length) + " of " + counted(rows.length) + " files";
    const turns = shown.length > AT_ONCE;
    field("count").textContent = turns ? all + ": " + counted(first + 1) + " to " + counted(end) : all;
    field("turns").hidden = !turns;
    field("previous").disabled = first === 0;
    field("next").disabled = end === shown.length;
  }
  function line(row) {
    if (row.line) return row.line;
    const made = element("tr"), cells = row.cells, name = element("td", undefined, "name");
    const button = element("button", undefined, "file");
    button.type = "button";
    button.setAttribute("aria-expanded", "false");
    button.append(element("bdi", cells[at.file]));
    name.append(button);
    if (cells[at.own] && mixed) name.append(element("span", "yours", "badge"));
    made.append(name);
    for (const key of ["supplier", "tire", "verdict"]) {
      const cell = element("td");
      cell.append(element("bdi", cells[at[key]]));
      made.append(cell);
    }
    made.append(element("td", number(cells[at.distance]), "number"), element("td", percent(cells[at.ratio]), "number"));
    made.append(element("td", cells[at.noted] ? counted(cells[at.noted]) : "–", "number"));
    made.addEventListener("click", () => { // of the button, too; a text that is being marked is no click
      if (getSelection().isCollapsed) toggle(row);
    });
    return row.line = made;
  }
  let mixed = false;

  // One file -------------------------------------------------------------------------------------------
  async function toggle(row) {
    const button = row.line.querySelector("button");
    if (row.detail) {
      row.detail.remove();
      row.detail = null;
    } else {
      row.detail = element("tr", undefined, "detail");
      const cell = element("td", undefined, "detail");
      cell.colSpan = 7;
      row.detail.append(cell);
      const detail = row.detail;
      await show(row, cell);
      if (row.detail === detail) row.line.after(detail);
    }
    row.line.classList.toggle("open", Boolean(row.detail));
    button.setAttribute("aria-expanded", String(Boolean(row.detail)));
  }
  async function part(index) {
    if (!opened.has(index)) {
      const [curves, numbers] = data.parts[index];
      opened.set(index, Promise.all([unpack(curves), unpackJson(numbers)]));
    }
    return opened.get(index);
  }
  async function show(row, cell) {
    const [bytes, all] = await part(Math.floor(row.index / data.together));
    const within = row.index % data.together, own = all[within], cells = row.cells;
    const bands = own.scales.some(each => each && each[2]);
    const said = [cells[at.verdict] + (cells[at.reason] ? ": " + cells[at.reason] : "")];
    said.push("Supplier: " + cells[at.supplier] + (cells[at.known] && cells[at.known] !== cells[at.supplier] ? " (" + cells[at.known] + ")" : ""));
    if (cells[at.protocol]) said.push("Protocol: " + cells[at.protocol]);
    const applied = cells[at.verdict] === "translated" ? ". The less certain a difference is, the less of it is applied to the file." : ".";
    if (cells[at.changes]) said.push("As estimated from the training files: " + cells[at.changes] + applied);
    if (cells[at.bias]) said.push("The supplier's bias against the target (90% bands): " + cells[at.bias]);
    if (cells[at.notes]) said.push(...cells[at.notes].split(data.between).map(each => "Note on the file: " + each));
    for (const each of said) {
      const paragraph = element("p");
      paragraph.append(element("bdi", each));
      cell.append(paragraph);
    }
    const panels = element("div", undefined, "panels"), left = [];
    const forces = unquantised(bytes, all, within);
    PANELS.forEach((panel, i) => {
      if (!forces[i]) left.push(panel.title + ": not drawn, because the file does not state all that it depends on.");
      else if (forces[i].zero) left.push(panel.title + ": not drawn, because it is zero at every slip and load.");
      else panels.append(forcePanel(panel, forces[i]));
    });
    const stiffness = own.stiffness && stiffnessPanel(own.stiffness);
    if (stiffness) panels.append(stiffness);
    if (!panels.children.length) {
      cell.append(element("p", "No curve of this file can be drawn."));
      return;
    }
    cell.append(legend(bands));
    if (bands) cell.append(element("p", "Where the band leaves the dashed line, the supplier's bias shows. Where the band contains the line, the two cannot be told apart."));
    cell.append(panels);
    for (const each of left) cell.append(element("p", each));
    if (own.moved.length) {
      cell.append(element("p", own.moved.length + " coefficients moved (at the translator's nominal load):"));
      const list = element("ul", undefined, "moved");
      for (const [name, from, to] of own.moved) list.append(element("li", name + ": " + from + " → " + to));
      cell.append(list);
    }
  }
  function unquantised(bytes, all, within) {
    const size = 3 * data.loads.length * data.slips.length;
    const counts = all.map(each => each.scales.filter(Boolean).length);
    let start = 0;
    for (let i = 0; i < within; i++) start += 2 * size * counts[i];
    const values = size * counts[within], low = start, high = start + values;
    let place = 0;
    return all[within].scales.map(scale => {
      if (!scale) return null;
      const curves = [];
      for (let k = 0; k < 3; k++) {
        const loads = [];
        for (let l = 0; l < data.loads.length; l++) {
          const curve = new Float64Array(data.slips.length);
          let value = 0, step = 0;
          for (let s = 0; s < curve.length; s++, place++) {
            let code = bytes[low + place] | (bytes[high + place] << 8);
            if (code > 32767) code -= 65536;
            step += code;
            value += step;
            curve[s] = value * scale[0] / data.levels;
          }
          loads.push(curve);
        }
        curves.push(loads);
      }
      return {zero: scale[0] === 0, source: scale[1] ? curves[0] : null, middle: scale[2] ? curves[1] : null, half: curves[2]};
    });
  }

  // Figures --------------------------------------------------------------------------------------------
  function axes(title, panel, xs, low, high) {
    const width = 360, height = 250, left = 52, right = 10, top = 24, bottom = 40;
    const x = value => left + (width - left - right) * (value - xs[0]) / (xs[1] - xs[0]);
    const y = value => top + (height - top - bottom) * (high - value) / (high - low || 1);
    const svg = drawn("svg", {viewBox: "0 0 " + width + " " + height, role: "img", "aria-label": title});
    svg.append(drawn("text", {x: left, y: 15, class: "label"}, title));
    for (const value of ticks(xs[0], xs[1])) {
      svg.append(drawn("line", {x1: x(value), x2: x(value), y1: top, y2: height - bottom, class: "grid"}));
      svg.append(drawn("text", {x: x(value), y: height - bottom + 14, "text-anchor": "middle", class: "tick"}, plain(value)));
    }
    for (const value of ticks(low, high)) {
      svg.append(drawn("line", {x1: left, x2: width - right, y1: y(value), y2: y(value), class: "grid"}));
      svg.append(drawn("text", {x: left - 5, y: y(value) + 4, "text-anchor": "end", class: "tick"}, plain(value)));
    }
    svg.append(drawn("rect", {x: left, y: top, width: width - left - right, height: height - top - bottom, class: "frame"}));
    svg.append(drawn("text", {x: (left + width - right) / 2, y: height - 8, "text-anchor": "middle", class: "label"}, panel.x));
    svg.append(drawn("text", {x: 12, y: (top + height - bottom) / 2, "text-anchor": "middle", class: "label",
      transform: "rotate(-90 12 " + (top + height - bottom) / 2 + ")"}, panel.y));
    return {svg, x, y};
  }
  function ticks(low, high) {
    const raw = (high - low) / 5, power = Math.pow(10, Math.floor(Math.log10(raw)));
    const step = [1, 2, 5, 10].map(each => each * power).find(each => each >= raw);
    const found = [];
    for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k++) found.push(k * step);
    return found;
  }
  function plain(value) {
    return Number(value.toPrecision(6)).toString();
  }
  function path(xs, ys, x, y) {
    return xs.map((each, i) => (i ? "L" : "M") + x(each).toFixed(1) + " " + y(ys[i]).toFixed(1)).join("");
  }
  function extent(curves) {
    let low = Infinity, high = -Infinity;
    for (const curve of curves) for (const value of curve) { low = Math.min(low, value); high = Math.max(high, value); }
    const margin = 0.05 * (high - low || 1);
    return [low - margin, high + margin];
  }
  function forcePanel(panel, force) {
    const xs = data.slips.map(slip => slip * panel.across), scaled = curve => Array.from(curve, value => value * panel.scale);
    const source = force.source && force.source.map(scaled), middle = force.middle && force.middle.map(scaled);
    const lows = middle && force.half.map((half, l) => scaled(half).map((value, s) => middle[l][s] - value));
    const highs = middle && force.half.map((half, l) => scaled(half).map((value, s) => middle[l][s] + value));
    const [low, high] = extent([...(source || []), ...(lows || []), ...(highs || [])]);
    const {svg, x, y} = axes(panel.title, panel, [xs[0], xs[xs.length - 1]], low, high);
    data.loads.forEach((_, l) => {
      if (middle) {
        const there = path(xs, highs[l], x, y), back = path([...xs].reverse(), [...lows[l]].reverse(), x, y);
        svg.append(drawn("path", {d: there + back.replace("M", "L") + "Z", class: "band l" + l}));
      }
    });
    data.loads.forEach((_, l) => {
      if (source) svg.append(drawn("path", {d: path(xs, source[l], x, y), class: "source l" + l}));
      if (middle) svg.append(drawn("path", {d: path(xs, middle[l], x, y), class: "middle l" + l}));
    });
    const figure = element("figure");
    figure.dataset.panel = panel.name;
    figure.append(svg, element("figcaption", panel.see));
    return figure;
  }
  function stiffnessPanel([source, middle, lows, highs]) {
    const whole = curve => curve.every(value => value !== null) ? curve.map(value => value * Math.PI / 180) : null;
    const own = whole(source), moved = whole(middle), low = whole(lows), high = whole(highs);
    if (!own && !moved) return null;
    const xs = data.loads.map(load => load / 1e3);
    const [least, largest] = extent([...[own, moved, low, high].filter(Boolean), [0]]);
    const title = "Cornering stiffness over load";
    const {svg, x, y} = axes(title, {x: "normal load (kN)", y: "stiffness (N/deg)"}, [xs[0], xs[xs.length - 1]], Math.max(0, least), largest);
    if (low && high) {
      const there = path(xs, high, x, y), back = path([...xs].reverse(), [...low].reverse(), x, y);
      svg.append(drawn("path", {d: there + back.replace("M", "L") + "Z", class: "band l0"}));
    }
    if (own) svg.append(drawn("path", {d: path(xs, own, x, y), class: "source l0"}));
    if (moved) svg.append(drawn("path", {d: path(xs, moved, x, y), class: "middle l0"}));
    xs.forEach((load, l) => svg.append(drawn("circle", {cx: x(load).toFixed(1), cy: y((moved || own)[l]).toFixed(1), r: 2.5, class: "dot l0"})));
    const figure = element("figure");
    figure.dataset.panel = "stiffness";
    const applied = own && moved ? " The translation changes it by " + signed(mean(moved.map((value, l) => value / own[l] - 1))) + " on average." : "";
    figure.append(svg, element("figcaption", "How the slope of the lateral force at zero grows with the load: computed at the loads with a dot." + applied));
    return figure;
  }
  function mean(values) {
    return values.reduce((sum, value) => sum + value, 0) / values.length;
  }
  function signed(share) {
    return (share < 0 ? "-" : "+") + Math.abs(100 * share).toFixed(1) + "%";
  }
  function legend(bands) {
    const list = element("ul", undefined, "legend");
    const entry = (className, text, shape) => {
      const item = element("li"), svg = drawn("svg", {viewBox: "0 0 32 12"});
      svg.append(shape === "band" ? drawn("rect", {x: 0, y: 1, width: 32, height: 10, class: className})
        : drawn("line", {x1: 0, x2: 32, y1: 6, y2: 6, class: className}));
      item.append(svg, text);
      list.append(item);
    };
    entry("source ink", "the file as it is");
    if (bands) {
      entry("middle ink", "translated");
      entry("band ink", "90% band: where the target's own measurement is expected", "band");
    }
    data.loads.forEach((load, l) => entry("middle l" + l, "normal load " + plain(load / 1e3) + " kN"));
    return list;
  }

  // Start ----------------------------------------------------------------------------------------------
  function options(name, key) {
    const select = field(name);
    const values = [...new Set(rows.map(row => row.cells[at[key]]))].sort((a, b) => a.localeCompare(b, "en", {numeric: true}));
    for (const value of values) {
      const option = element("option", value);
      option.value = value;
      select.append(option);
    }
  }
  async function start() {
    rows = (await unpackJson(data.rows)).map((cells, index) =>
      ({cells, index, text: cells.filter(each => typeof each === "string").join("\n").toLowerCase(), line: null, detail: null}));
    const own = rows.filter(row => row.cells[at.own]).length;
    mixed = own > 0 && own < rows.length;
    field("whose-label").hidden = !mixed;
    options("supplier", "supplier");
    options("verdict", "verdict");
    options("tires", "tire");
    for (const name of ["search", "tire"]) field(name).addEventListener("input", choose);
    for (const name of ["supplier", "verdict", "whose", "noted"]) field(name).addEventListener("change", choose);
    field("controls").addEventListener("submit", event => event.preventDefault());
    field("controls").addEventListener("reset", () => setTimeout(() => {
      sort = null;
      document.querySelectorAll("#files th").forEach(each => each.removeAttribute("aria-sort"));
      choose();
    }));
    for (const [name, way] of [["previous", -1], ["next", 1]]) {
      field(name).addEventListener("click", () => {
        turn(first + way * AT_ONCE);
        field("count").scrollIntoView();
      });
    }
    for (const button of document.querySelectorAll("[data-supplier]")) {
      button.addEventListener("click", () => {
        field("supplier").value = button.dataset.supplier;
        choose();
        field("files").scrollIntoView();
      });
    }
    for (const button of document.querySelectorAll("[data-sort]")) {
      button.addEventListener("click", () => {
        falling = sort === button.dataset.sort && !falling;
        sort = button.dataset.sort;
        document.querySelectorAll("#files th").forEach(each => each.removeAttribute("aria-sort"));
        button.parentElement.setAttribute("aria-sort", falling ? "descending" : "ascending");
        choose();
      });
    }
    choose();
    document.body.dataset.ready = "yes";
  }
  start().catch(error => { field("count").textContent = "The data cannot be opened: " + error.message; });
})();
