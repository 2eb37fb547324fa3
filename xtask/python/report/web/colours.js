// A colour of the style sheet by its name: light, dark or printed, whichever is in force.
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
