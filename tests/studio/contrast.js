// Texts of the page whose contrast to what is behind them is below 4.5, as WCAG 2 computes it:
// [ratio, element, text].
(() => {
  const context = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgba = colour => {
    context.clearRect(0, 0, 1, 1);
    context.fillStyle = colour;
    context.fillRect(0, 0, 1, 1);
    return [...context.getImageData(0, 0, 1, 1).data];
  };
  const luminance = colour => {
    const [r, g, b] = colour.map(v => v / 255).map(v => v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4);
    return .2126 * r + .7152 * g + .0722 * b;
  };
  const over = (below, layer) => below.map((v, k) => v + (layer[k] - v) * layer[3] / 255);
  const behind = node => {
    const layers = [];
    for (let one = node; one; one = one.parentElement) layers.unshift(rgba(getComputedStyle(one).backgroundColor));
    return layers.reduce(over, [255, 255, 255]);
  };
  const found = [];
  for (const node of document.querySelectorAll("body *")) {
    const says = [...node.childNodes].some(one => one.nodeType === 3 && one.data.trim()) || (node.matches("input:not([type=range]), select") && node.value);
    if (!says || node.disabled || !node.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
    const back = behind(node), front = over(back, rgba(getComputedStyle(node).color));
    const [high, low] = [luminance(front), luminance(back)].sort((a, b) => b - a);
    const ratio = (high + .05) / (low + .05);
    if (ratio < 4.5) found.push([ratio, `${node.tagName}#${node.id}`, node.textContent.slice(0, 30)]);
  }
  return found;
})()
