// The contrast to the ground of each colour that a chart below `root` draws with (WCAG 2.2, 1.4.11 asks for 3 : 1).
(root) => {
  const numbers = (color) => color.match(/[\d.]+/g).map(Number).slice(0, 3);
  const linear = (part) => (part / 255 <= 0.03928 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4);
  const light = ([red, green, blue]) => 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
  const ground = light(numbers(getComputedStyle(root).backgroundColor));
  const probe = root.querySelector(".ros-chart").appendChild(document.createElement("i"));
  const names = [0, 1, 2, 3, 4, 5].map((index) => `var(--ros-series-${index})`).concat("var(--ros-muted)", "var(--ros-text)");
  const ratios = names.map((name) => {
    probe.style.color = name;
    const both = [light(numbers(getComputedStyle(probe).color)), ground].sort((one, other) => other - one);
    return (both[0] + 0.05) / (both[1] + 0.05);
  });
  probe.remove();
  return ratios;
}
