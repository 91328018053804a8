// Colours of what is drawn, light and dark.

const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
const all = (list) => new Float32Array(list.flatMap(rgb));

const LOOKS = {
  light: {
    palette: all(["#4f8ff7", "#f2795c", "#38b48b", "#f2b84b", "#8f78e8", "#e8739b", "#46b3cf", "#9bbf4d"]),
    fixed: rgb("#a9b4c4"),
    kinematic: rgb("#b58cf2"),
    sensor: rgb("#e8a33a"),
    water: rgb("#4096d2"),
    deep: rgb("#35688f"),
    back: rgb("#f4f6fa"),
    grid: rgb("#e3e8f0"),
    accent: rgb("#111827"),
    dim: 0.3,
  },
  dark: {
    palette: all(["#5b9cff", "#ff8a6b", "#45c79b", "#ffc861", "#a08cff", "#ff86ae", "#58c9e6", "#aed25c"]),
    fixed: rgb("#4a5568"),
    kinematic: rgb("#c09cff"),
    sensor: rgb("#ffbe55"),
    water: rgb("#3884d6"),
    deep: rgb("#1f4a80"),
    back: rgb("#0f131b"),
    grid: rgb("#1a202c"),
    accent: rgb("#ffffff"),
    dim: 0.36,
  },
};

export const look = (dark) => LOOKS[dark ? "dark" : "light"];
