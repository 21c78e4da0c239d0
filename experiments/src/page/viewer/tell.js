// What a picture shows, in words, and the places of the events in the exact order as a small plot.

const FATES = {
  flipped: "flipped in its turn",
  postponed: "impossible now: put into the list L (third patch)",
  outside: "would remove a tetrahedron outside the region: discarded (first patch)",
  "from-list": "flipped from the list L (third patch)",
  dropped: "leaves the list L, because its triangle is gone",
  "non-crossing": "flip between tetrahedra that do not cross (second patch)",
};

const FLIPS = { 23: "2-3 flip", 32: "3-2 flip", 44: "4-4 flip" };

const PIECES = {
  schoenhardt: "half of what they fill is Schönhardt’s polyhedron, which has no tetrahedralization",
  "no-tetrahedralization": "what they fill has no tetrahedralization that does not cross the polygon",
  tetrahedralizable: "what they fill has a tetrahedralization that flips did not find",
  undecided: "what they fill is too large for an exhaustive search",
};

const count = (n, one, many) => `${n} ${n === 1 ? one : many}`;

/** How many crossing tetrahedra there are, and so on. */
function tellStatus(run, k) {
  const { crossing, size, flips, listed } = run.after[k];
  const list = listed > 0 ? `, ${listed} in the list L` : "";
  return `<b>${k}</b> of ${count(run.steps.length, "event", "events")}, ${count(flips, "flip", "flips")}${list}; ` +
    `<b>${crossing}</b> of ${count(size, "tetrahedron", "tetrahedra")} ${crossing === 1 ? "crosses" : "cross"} the polygon`;
}

/** Edge and triangle that a flip exchanges. */
function exchanged(scene, step) {
  const name = (v) => `<b>${scene.names[v]}</b>`;
  const names = (list) => list.map(name).join(" ");
  const inAll = (tets) => step.circuit.filter((v) => tets.every((t) => scene.tets[t].includes(v)));
  const [gone, made] = [inAll(step.removed), inAll(step.created)];
  switch (step.flip) {
    case 23:
      return `triangle ${names(gone)} goes, edge ${names(made)} comes`;
    case 32:
      return `edge ${names(gone)} goes, triangle ${names(made)} comes`;
    case 44:
      return `edge ${names(gone)} is turned over to ${names(made)}`;
    default:
      return `triangle ${names(step.circuit.slice(1, 4))} between ${name(step.circuit[0])} and ${name(step.circuit[4])}`;
  }
}

function tellTime(step) {
  const times = [];
  if (step.exact !== null) times.push(`τ = ${time(step.exact)} (exact, rounded to print)`);
  else times.push("exact numbers would never queue it (D ≤ 0)");
  if (step.rounded !== null) times.push(tellRounded(step));
  return times.join("; ");
}

/** Doubles give several times, by the order in which a tetrahedron's vertices are stored. */
function tellRounded({ exact, rounded: [least, most] }) {
  const one = least === most;
  const values = one ? time(least) : `${time(least)} to ${time(most)}`;
  const off = exact === null ? "" : one ? `, ${ulps(exact, least)}` : `: ${ulps(exact, least)} to ${ulps(exact, most)}`;
  return `${values} in f64${one ? "" : ", by the order of the vertices"}${off}`;
}

const time = (value) => `<span class="time">${value}</span>`;

function ulps(exact, rounded) {
  const off = ulpsBetween(exact, rounded);
  if (off === 0n) return "the same";
  const size = off < 0n ? -off : off;
  const many = size > 1000000n ? Number(size).toExponential(1) : String(size);
  return `${many} ${size === 1n ? "ulp" : "ulps"} ${off < 0n ? "early" : "late"}`;
}

/** The event that has just happened, in HTML. */
function tellEvent(scene, run, k) {
  if (k === 0) return "<p>Before the first event.</p>";
  const step = run.steps[k - 1];
  const flip = step.flip > 0 ? `<strong>${FLIPS[step.flip]}</strong>: ` : "<strong>No flip</strong>: ";
  const rank = step.rank === null ? "" : ` Place in the exact order: <b class="${step.late ? "late" : ""}">${step.rank}</b> of ${run.ranks}${
    step.late ? ", <span class=\"late\">after one that is later</span>" : ""}.`;
  const fate = step.fate === "flipped" && step.flip > 0 ? "" : ` ${capital(FATES[step.fate])}.`;
  const circuit = step.circuit.map((v) => scene.names[v]).join(" ");
  return `<p>${flip}${exchanged(scene, step)}.${fate}${rank}</p>` +
    `<p class="detail">Circuit ${circuit}.${step.fate === "non-crossing" ? "" : ` ${capital(tellTime(step))}.`}</p>${k === run.steps.length ? tellEnd(run) : ""}`;
}

const capital = (text) => (text[0] === "τ" ? text : text[0].toUpperCase() + text.slice(1));

/** How the run ended, in HTML. */
function tellEnd(run) {
  if (run.outcome === "ok") {
    return `<p class="end good">Done: these ${run.end.length} tetrahedra are those of the constrained Delaunay tetrahedralization.</p>`;
  }
  const what = {
    stuck: `Stuck: nothing on the queue or in the list L can be flipped, and ${count(run.left, "crossing tetrahedron is", "crossing tetrahedra are")} left`,
    "not-delaunay": `No crossing tetrahedron is left, but this is not the CDT: ${count(run.bad.length, "triangle is", "triangles are")} not locally Delaunay`,
  }[run.outcome] ?? `Failed: ${run.outcome}`;
  const pieces = run.pieces.map(([kind]) => PIECES[kind] ?? kind);
  return `<p class="end bad">${[what, ...new Set(pieces)].join("; ")}.</p>`;
}

/** The events in the order in which they came, each as high as its place in the exact order. */
function rankPlot(run, k) {
  const alive = run.steps.map((step, i) => ({ step, i })).filter(({ step }) => step.rank !== null);
  const n = Math.max(alive.length, 1);
  const [w, h, pad] = [420, 110, 8];
  const x = (i) => pad + ((w - 2 * pad) * (i + 0.5)) / n;
  const y = (rank) => h - pad - ((h - 2 * pad) * (rank - 0.5)) / n;
  const radius = Math.max(1.6, Math.min(4.5, (h - 2 * pad) / n));
  const dots = alive.map(({ step, i }, j) => {
    const state = [step.late ? "late" : "", i < k ? "past" : "", i === k - 1 ? "now" : ""].join(" ").trim();
    return `<circle data-step="${i + 1}" class="${state}" cx="${x(j).toFixed(1)}" cy="${y(step.rank).toFixed(1)}" r="${radius.toFixed(1)}"/>`;
  });
  const late = alive.filter(({ step }) => step.late).length;
  const text = late === 0 ? "all in order" : `${late} after one that is later`;
  return `<svg viewBox="0 0 ${w} ${h}" role="img" aria-label="Places in the exact order of ${alive.length} events: ${text}">` +
    `<rect x="0.5" y="0.5" width="${w - 1}" height="${h - 1}"/>${dots.join("")}</svg>` +
    `<p class="caption">Events from left to right as they came off the queue, each as high as its place in the exact order: ${text}.</p>`;
}

/** All events as list items. */
function listEvents(scene, run) {
  return run.steps.map((step, i) => {
    const flip = step.flip > 0 ? FLIPS[step.flip] : "no flip";
    const rank = step.rank === null ? "" : `, place ${step.rank}`;
    const fate = step.fate === "flipped" ? "" : `; ${FATES[step.fate]}`;
    return `<li><button type="button" data-step="${i + 1}"${step.late ? " class=\"late\"" : ""}>${flip}, ${exchanged(scene, step)}${rank}${fate}</button></li>`;
  }).join("");
}
