//! SVG to PNG.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use crate::export::pictures::PlotError;

/// PNG pixels per SVG pixel.
const DENSITY: u8 = 2;

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(notosans::REGULAR_TTF.to_vec());
    fonts.set_sans_serif_family("Noto Sans");
    Arc::new(fonts)
});

/// Rasterises an SVG.
///
/// # Errors
/// [`PlotError`] if the SVG cannot be parsed or is empty.
pub fn png(svg: &str) -> Result<Vec<u8>, PlotError> {
    let fail = |reason: String| PlotError::Raster(reason);
    let options = Options {
        fontdb: Arc::clone(&FONTS),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|error| fail(error.to_string()))?;
    let size = tree.size().to_int_size();
    let pixels = (
        u32::from(DENSITY) * size.width(),
        u32::from(DENSITY) * size.height(),
    );
    let mut pixmap = Pixmap::new(pixels.0, pixels.1)
        .ok_or_else(|| fail("the drawing has no area".to_owned()))?;
    let density = f32::from(DENSITY);
    resvg::render(
        &tree,
        Transform::from_scale(density, density),
        &mut pixmap.as_mut(),
    );
    pixmap.encode_png().map_err(|error| fail(error.to_string()))
}
