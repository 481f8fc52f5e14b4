/* Read into a page of the program by make.sh: puts pictures of it beside each other as one WebP, or takes out a drawing as
 * it is, and leaves that as the document's only text. */
const GAP = 18;

/* A drawing of the page by itself, with what the page's style says of it on light paper. Names of nozzles may stick out of views. */
function alone(svg) {
  const copy = svg.cloneNode(true), style = document.createElementNS('http://www.w3.org/2000/svg', 'style');
  const aside = svg.classList.contains('view') ? 30 : 0, [, , within, height] = svg.getAttribute('viewBox').split(' ');
  const width = +within + 2 * aside;
  copy.setAttribute('viewBox', `${-aside} 0 ${width} ${height}`);
  copy.setAttribute('width', width);
  copy.setAttribute('height', height);
  const applies = rule => rule.selectorText === ':root' || svg.matches(rule.selectorText) || svg.querySelector(rule.selectorText);
  style.textContent = [...document.styleSheets[0].cssRules].filter(rule => rule.selectorText && applies(rule)).map(rule => rule.cssText)
                          .join('\n') + '\nsvg{background:#fff;font-family:"DejaVu Sans",sans-serif}';
  copy.prepend(style);
  return new XMLSerializer().serializeToString(copy);
}

function loaded(picture) {
  return new Promise((resolve, reject) => {
    const image = new Image();
    image.onload = () => resolve(image);
    image.onerror = reject;
    image.src = picture instanceof SVGElement ? 'data:image/svg+xml;charset=utf-8,' + encodeURIComponent(alone(picture)) : picture.src;
  });
}

function leave(text) {
  document.documentElement.textContent = `PICTURE:${text}:`;
}

/* pictures: [{of: element, crop: [left, top, width, height] in parts of it}], drawn to one height; beneath them a colour bar,
 * where one is given, as wide as they are or as it is. */
async function sheet(pictures, height, bar) {
  const cells = [], below = bar && await loaded(bar);
  for (const {of, crop = [0, 0, 1, 1]} of pictures) {
    const image = await loaded(of);
    cells.push({image, crop, width: height * image.width * crop[2] / (image.height * crop[3])});
  }
  const canvas = document.createElement('canvas');
  canvas.width = cells.reduce((sum, cell) => sum + cell.width + GAP, -GAP);
  const barWidth = below ? Math.min(below.width, canvas.width) : 0, barHeight = below ? below.height * barWidth / below.width : 0;
  canvas.height = height + (below ? GAP + barHeight : 0);
  const paint = canvas.getContext('2d');
  paint.imageSmoothingQuality = 'high';
  paint.fillStyle = '#fff';
  paint.fillRect(0, 0, canvas.width, canvas.height);
  let left = 0;
  for (const {image, crop, width} of cells) {
    paint.drawImage(image, crop[0] * image.width, crop[1] * image.height, crop[2] * image.width, crop[3] * image.height, left, 0, width,
                    height);
    left += width + GAP;
  }
  if (below)
    paint.drawImage(below, (canvas.width - barWidth) / 2, height + GAP, barWidth, barHeight);
  leave(canvas.toDataURL('image/webp', 0.8).split(',')[1]);
}
