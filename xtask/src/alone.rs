//! One process at a time, by a lock on a file.

use anyhow::{Context, Result};
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

/// How often one looks which of several locks is free.
const LOOK_AGAIN: Duration = Duration::from_millis(100);

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

/// Which of these locks is free first, and that one, held; `waits` is called where none is now.
pub fn first_free(locks: &[PathBuf], waits: impl FnOnce()) -> Result<(usize, File)> {
    let mut waits = Some(waits);
    loop {
        for (which, lock) in locks.iter().enumerate() {
            fs::create_dir_all(lock.parent().context("a lock lies in a folder")?)?;
            let file = File::create(lock)?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => (),
                tried => return Ok((which, tried.map(|()| file)?)),
            }
        }
        waits.take().into_iter().for_each(|waits| waits());
        thread::sleep(LOOK_AGAIN);
    }
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
    use super::{Duration, Result, first_free, fs, once, thread};
    use crate::paths;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn the_lock_that_is_free_first_is_taken() {
        let folder = paths::target().join(format!("tests/first_free-{}", std::process::id()));
        let locks = [0, 1].map(|which| folder.join(format!("{which}/lock")));
        let take = || first_free(&locks, || panic!("one is free")).unwrap();
        let [first, second] = [(); 2].map(|()| take());
        assert_eq!([first.0, second.0], [0, 1]);
        drop(second);
        assert_eq!(take().0, 1);
        let (second, waited) = (take(), AtomicUsize::new(0));
        thread::scope(|scope| {
            let third = scope.spawn(|| first_free(&locks, || _ = waited.fetch_add(1, Ordering::SeqCst)).unwrap().0);
            while waited.load(Ordering::SeqCst) == 0 {
                thread::sleep(Duration::from_millis(1));
            }
            drop(second);
            assert_eq!(third.join().unwrap(), 1, "the other is held");
        });
        assert_eq!(waited.into_inner(), 1);
        fs::remove_dir_all(folder).unwrap();
    }

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
