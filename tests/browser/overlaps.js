// Returns the texts of a chart that overlap each other.
(root) => {
  const boxes = [...root.querySelectorAll(".ros-chart-canvas text")].map((each) => [each.textContent, each.getBoundingClientRect()]);
  return boxes.flatMap(([one, a], index) => boxes.slice(0, index).filter(([, b]) =>
    a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 3 && b.top < a.bottom - 3).map(([other]) => `${one} over ${other}`));
}
