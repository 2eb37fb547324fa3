//! One process at a time, by a lock on a file.

use anyhow::{Context, Result};
use std::fs::{self, File, TryLockError};
use std::path::Path;

/// Until it is dropped nobody else holds this lock; `waits` is called where somebody does now.
pub fn alone(lock: &Path, waits: impl FnOnce()) -> Result<File> {
    fs::create_dir_all(lock.parent().context("a lock lies in a folder")?)?;
    let lock = File::create(lock)?;
    match lock.try_lock() {
        Err(TryLockError::WouldBlock) => {
            waits();
            lock.lock()?;
        }
        tried => tried?,
    }
    Ok(lock)
}

/// What is there already, or else is made by one alone: who waited for the lock looks again.
pub fn once<T>(
    lock: &Path,
    look: impl Fn() -> Option<T>,
    waits: impl FnOnce(),
    make: impl FnOnce() -> Result<T>,
) -> Result<T> {
    if let Some(there) = look() {
        return Ok(there);
    }
    let _alone = alone(lock, waits)?;
    look().map_or_else(make, Ok)
}

#[cfg(test)]
mod tests {
    use super::{Result, fs, once};
    use crate::paths;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;
    use std::time::Duration;

    #[test]
    fn three_at_once_make_it_once_and_two_say_that_they_wait() {
        let folder = paths::target().join("tests/alone");
        let _ = fs::remove_dir_all(&folder);
        let file = folder.join("made");
        let [made, waited] = [const { AtomicUsize::new(0) }; 2];
        let take = || -> Result<String> {
            once(
                &folder.join("lock"),
                || fs::read_to_string(&file).ok(),
                || _ = waited.fetch_add(1, Ordering::SeqCst),
                || {
                    made.fetch_add(1, Ordering::SeqCst);
                    // The others have come meanwhile.
                    while waited.load(Ordering::SeqCst) < 2 {
                        thread::sleep(Duration::from_millis(1));
                    }
                    fs::write(&file, "it")?;
                    Ok("it".into())
                },
            )
        };
        thread::scope(|scope| {
            let all = [(); 3].map(|()| scope.spawn(take));
            all.into_iter().for_each(|one| assert_eq!(one.join().unwrap().unwrap(), "it"));
        });
        assert_eq!([made.into_inner(), waited.into_inner()], [1, 2]);
    }
}
