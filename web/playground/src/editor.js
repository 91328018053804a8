// The scene file as text: completion from the schema, errors of the engine at their line, run as you type.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { json, jsonLanguage } from "@codemirror/lang-json";
import { bracketMatching, foldGutter, foldKeymap, HighlightStyle, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { hoverTooltip } from "@codemirror/view";
import { disableErrorLogging } from "best-effort-json-parser";
import { jsonCompletion, jsonSchemaHover, stateExtensions } from "codemirror-json-schema";
import schema from "../../../scenes/scene.schema.json";
import { h, icon } from "./dom.js";

// Text that is being written is no JSON most of the time.
disableErrorLogging();

/** Milliseconds without a key until the text is run. */
const PAUSE = 600;
/** Longer texts are run only when that is asked for. */
const LONG = 400_000;

const colours = HighlightStyle.define([
  { tag: tags.propertyName, color: "var(--code-name)" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: tags.number, color: "var(--code-number)" },
  { tag: [tags.bool, tags.null], color: "var(--code-word)" },
  { tag: tags.punctuation, color: "var(--muted)" },
]);

export function editor(app, root) {
  let own = false;
  let timer;
  /** The scene that was last shown; what has been written since stays until another is opened. */
  let shown;
  const problem = h("p.problem", { hidden: true, role: "alert" });

  const view = new EditorView({
    parent: root,
    state: EditorState.create({
      doc: "",
      extensions: [
        lineNumbers(),
        foldGutter(),
        history(),
        drawSelection(),
        indentOnInput(),
        bracketMatching(),
        closeBrackets(),
        autocompletion(),
        highlightActiveLine(),
        lintGutter(),
        json(),
        jsonLanguage.data.of({ autocomplete: jsonCompletion() }),
        hoverTooltip(jsonSchemaHover()),
        stateExtensions(schema),
        syntaxHighlighting(colours),
        EditorView.lineWrapping,
        keymap.of([
          { key: "Mod-Enter", run: () => (run(), true) },
          ...closeBracketsKeymap,
          ...completionKeymap,
          ...defaultKeymap,
          ...historyKeymap,
          ...foldKeymap,
          indentWithTab,
        ]),
        EditorView.updateListener.of((update) => {
          if (!update.docChanged || own) return;
          clearTimeout(timer);
          if (update.state.doc.length < LONG) timer = setTimeout(run, PAUSE);
        }),
      ],
    }),
  });

  root.append(
    problem,
    h(
      "div.row",
      {},
      h("button.wide.primary", { onclick: () => run(), title: "Run the text (Ctrl+Enter)" }, icon("play"), "Run"),
      h("button.wide", { onclick: () => load(BLANK, true), title: "A small scene to begin with" }, icon("file-plus"), "New"),
    ),
  );

  /** Runs the text; says where it is wrong. */
  function run() {
    clearTimeout(timer);
    const text = view.state.doc.toString();
    try {
      app.open(text, { keepCamera: app.scene !== undefined, keepPlaying: true });
      shown = text;
      report();
    } catch (error) {
      report(error.message);
    }
  }

  function report(message) {
    problem.hidden = !message;
    problem.textContent = message ?? "";
    let found = [];
    const place = message?.match(/^line (\d+) column (\d+): /);
    if (place) {
      const { doc } = view.state;
      const line = doc.line(Math.min(Number(place[1]), doc.lines));
      const from = Math.min(line.from + Math.max(0, Number(place[2]) - 1), line.to);
      found = [{ from: Math.min(from, Math.max(line.from, line.to - 1)), to: line.to, severity: "error", message: message.slice(place[0].length) }];
    }
    view.dispatch(setDiagnostics(view.state, found));
  }

  function load(text, runs = false) {
    own = true;
    view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
    own = false;
    if (runs) run();
    else report();
  }

  function show() {
    if (app.source === shown) return;
    shown = app.source;
    if (view.state.doc.toString() !== app.source) load(app.source);
  }

  return { show, load, run, view };
}

export const BLANK = `{
  "version": 1,
  "name": "my scene",
  "description": "A crate and a ball fall on a floor.",
  "bodies": [
    { "kind": "static", "shapes": [{ "shape": { "rect": { "half_extents": [12, 0.5] } } }] },
    { "position": [0, 4], "shapes": [{ "shape": { "rect": { "half_extents": [0.5, 0.5] } } }] },
    {
      "position": [0.3, 6],
      "shapes": [{ "shape": { "circle": { "radius": 0.4 } }, "material": { "restitution": 0.5 } }]
    }
  ]
}
`;
