//! Compiles the templates of modelDescription/ in.

/// The ends of their names.
const TEMPLATES: [&str; 4] = [".html", ".svg", ".xml", "matrices.h"];

fn main() {
    minijinja_embed::embed_templates!("../modelDescription", &TEMPLATES[..]);
}
