// Returns the contrast between the line of a chart and the background of the chart (WCAG 2.2, 1.4.11 requires
// 3 : 1).
(root) => {
  const numbers = (color) => color.match(/[\d.]+/g).map(Number).slice(0, 3);
  const linear = (part) => (part / 255 <= 0.03928 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4);
  const light = ([red, green, blue]) => 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
  const ground = light(numbers(getComputedStyle(root).backgroundColor));
  const line = light(numbers(getComputedStyle(root.querySelector(".ros-chart-line")).stroke));
  const [high, low] = [line, ground].sort((one, other) => other - one);
  return (high + 0.05) / (low + 0.05);
}
