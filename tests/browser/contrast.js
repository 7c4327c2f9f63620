// Returns the texts in a part of the page that have a contrast below 4.5 : 1 to their background (WCAG 2.2,
// 1.4.3). The background of a text is the background of its nearest ancestor with a background colour. The
// function does not check disabled controls and texts for screen readers.
(root) => {
  const numbers = (color) => (color.match(/[\d.]+/g) ?? []).map(Number);
  const linear = (part) => (part / 255 <= 0.03928 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4);
  const light = ([red, green, blue]) => 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
  const ground = (element) => {
    for (let each = element; each; each = each.parentElement) {
      const color = numbers(getComputedStyle(each).backgroundColor);
      if (color.length === 3 || color[3] === 1) return color;
    }
    return [255, 255, 255];
  };
  const ratio = (element) => {
    const lights = [numbers(getComputedStyle(element).color), ground(element)].map(light).sort((one, other) => other - one);
    return (lights[0] + 0.05) / (lights[1] + 0.05);
  };
  const speaks = (element) => [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim())
    && element.checkVisibility() && !element.closest("svg, .ros-hidden, [aria-disabled]");
  return [...root.querySelectorAll("*")].filter(speaks).filter((each) => ratio(each) < 4.5)
    .map((each) => `${ratio(each).toFixed(2)} ${each.outerHTML.slice(0, 90)}`);
}
