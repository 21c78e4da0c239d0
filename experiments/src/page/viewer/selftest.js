// Steps through everything and compares it with what the experiments recorded, when the page is opened with #selftest; what
// comes of it is the text of an element, for a browser without a window. With #scene=1&step=5 it only goes there.

function selfTest() {
  const problems = [];
  const check = (holds, what) => { if (!holds) problems.push(what); };
  const same = (a, b) => a.length === b.length && a.every((x, i) => x === b[i]);
  let steps = 0;
  for (const scene of viewer.scenes) {
    viewer.choose(scene);
    for (const run of scene.runs) {
      const name = `${scene.name}, ${run.times}`;
      check(same(tetsAfter(scene, run, 0), scene.before), `${name}: the beginning`);
      for (let k = 1; k <= run.steps.length; k += 1) {
        const [step, before, after] = [run.steps[k - 1], tetsAfter(scene, run, k - 1), tetsAfter(scene, run, k)];
        check(step.removed.every((t) => before.includes(t) && !after.includes(t)), `${name}: removed by ${k}`);
        check(step.created.every((t) => !before.includes(t) && after.includes(t)), `${name}: made by ${k}`);
        const { crossing, size } = run.after[k];
        check(size === after.length && crossing === after.filter((t) => scene.crosses[t]).length, `${name}: counts after ${k}`);
        const kind = { 23: [2, 3], 32: [3, 2], 44: [4, 4], 0: [0, 0] }[step.flip];
        check(same([step.removed.length, step.created.length], kind), `${name}: kind of ${k}`);
        if (run.times === "exact") check(step.fate === "flipped" && !step.late, `${name}: ${k} in its turn`);
        steps += 1;
      }
      const end = tetsAfter(scene, run, run.steps.length);
      check(same(end, run.end), `${name}: the end`);
      const crossing = end.filter((t) => scene.crosses[t]).length;
      check(crossing === (run.outcome === "stuck" ? run.left : 0), `${name}: ${crossing} crossing`);
      check((run.bad.length > 0) === (run.outcome === "not-delaunay"), `${name}: ${run.bad.length} triangles not Delaunay`);
    }
    check(scene.runs[0].outcome === "ok", `${scene.name}: the exact order ends in the CDT`);
    const agree = same(scene.runs[0].end, scene.runs[1].end);
    check(agree === (scene.runs[1].outcome === "ok"), `${scene.name}: both end alike`);
    walk(scene, check);
  }
  document.querySelectorAll("details").forEach((details) => { details.open = true; });
  document.querySelectorAll("table[data-rows]").forEach((table) => {
    fillTable(table);
    check(table.tBodies[0].rows.length > 0, `rows of ${table.dataset.rows}`);
  });
  document.querySelectorAll("table.data").forEach((table) => tryTable(table, check));
  check(document.querySelectorAll("table.paper").length === 2, "the paper’s tables");
  return { problems, steps };
}

/** Sorts a table by its first column of numbers, if it can be, and filters it, if it can be, and undoes that. */
function tryTable(table, check) {
  const name = table.querySelector("th").textContent;
  const [header, body] = [table.tHead.rows[0], table.tBodies[0]];
  const column = [...header.cells].findIndex((cell) => cell.classList.contains("n"));
  const button = header.cells[column]?.querySelector("button");
  if (button) {
    button.click();
    const values = [...body.rows].map((row) => numberIn(row.cells[column])).filter((x) => !Number.isNaN(x));
    check(values.every((x, i) => i === 0 || values[i - 1] <= x), `${name}: sorted`);
  }
  const input = table.closest(".scroll").previousElementSibling?.querySelector("input[type=search]");
  if (input) {
    const shown = () => [...body.rows].filter((row) => !row.hidden).length;
    const filter = (text) => { input.value = text; input.dispatchEvent(new Event("input")); };
    filter(body.rows[0].cells[0].textContent);
    check(shown() >= 1, `${name}: filtered`);
    filter("no row has these words");
    check(shown() === 0, `${name}: all filtered away`);
    filter("");
    check(shown() === body.rows.length, `${name}: all back`);
  }
}

/** With the viewer's own controls, to the end and back, in both modes. */
function walk(scene, check) {
  for (const mode of ["count", "time"]) {
    viewer.setMode(mode);
    const last = viewer.steps().length - 1;
    const text = () => [...document.querySelectorAll(".teller")].map((t) => t.textContent).join();
    const start = text();
    for (let i = 0; i < last; i += 1) document.getElementById("v-on").click();
    check(viewer.state.position === last, `${scene.name}, ${mode}: the last step`);
    check(same2(viewer.steps()[last], scene.runs.map((run) => run.steps.length)), `${scene.name}, ${mode}: both at their ends`);
    check(document.querySelectorAll(".event .end").length === 2, `${scene.name}, ${mode}: both ends are told`);
    if (viewer.works) {
      viewer.stages.forEach((stage, i) => {
        stage.render(viewer.view);
        check(stage.colours() > 8, `${scene.name}, ${mode}: picture ${i} has ${stage.colours()} colours`);
      });
    }
    for (let i = 0; i < last; i += 1) document.getElementById("v-back").click();
    check(viewer.state.position === 0 && text() === start, `${scene.name}, ${mode}: back at the beginning`);
  }
}

const same2 = (a, b) => a.every((x, i) => x === b[i]);

if (location.hash === "#selftest") {
  const output = document.getElementById("selftest");
  output.hidden = false;
  const errors = [];
  window.addEventListener("error", (event) => errors.push(event.message));
  try {
    const { problems, steps } = selfTest();
    const all = [...problems, ...errors];
    output.textContent = all.length === 0
      ? `PASSED: ${viewer.scenes.length} scenes, ${steps} steps, WebGL ${viewer.works ? "drawn" : "missing"}`
      : `FAILED: ${all.slice(0, 20).join("; ")}`;
  } catch (error) {
    output.textContent = `FAILED: ${error.stack}`;
  }
} else if (location.hash.startsWith("#scene=")) {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const scene = viewer.scenes[Number(wanted.get("scene"))] ?? viewer.scenes[0];
  document.getElementById("v-scene").value = viewer.scenes.indexOf(scene);
  viewer.choose(scene);
  viewer.go(Number(wanted.get("step") ?? 0));
  document.getElementById("viewer").scrollIntoView();
}
