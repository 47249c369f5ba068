//! What a window shows, kept in a file.

use super::super::encoded;
use super::Desk;
use hapticbillard::renderer::Words;

impl Desk<'_> {
    /// Writes what the window shows into a file, and says where.
    pub(super) fn keep_picture(&mut self, rows: &[[u8; 4]], size: (u32, u32)) {
        let kept = encoded(rows, size)
            .map_err(|error| error.to_string())
            .and_then(|png| self.host.picture(&png).map_err(|error| error.to_string()));
        let words = Words::new(self.spoken);
        let said = match kept {
            Ok(path) => words.fill("picture", "path", &path.display().to_string()),
            Err(reason) => words.fill("no_picture", "reason", &reason),
        };
        self.say(said);
    }
}
