//! Undo and redo over whole states; the changes of one gesture make one named step.

/// States kept at most. A state is small, because copies of a scene share their control points.
const CAPACITY: usize = 500;

/// The states before and after the present state, each with the name of the step between it and the next state towards the present.
#[derive(Debug)]
pub(crate) struct History<State, Key> {
    before: Vec<(State, String)>,
    after: Vec<(State, String)>,
    /// The key of the current gesture: its later changes add no state.
    gesture: Option<Key>,
}

impl<State, Key> Default for History<State, Key> {
    fn default() -> Self {
        Self { before: Vec::new(), after: Vec::new(), gesture: None }
    }
}

impl<State, Key: Copy + PartialEq> History<State, Key> {
    /// Keeps `present`, the state before a change, under the change's name, unless the current gesture has the same key.
    pub(crate) fn record(&mut self, present: State, key: Key, name: impl FnOnce() -> String) {
        self.after.clear();
        if self.gesture == Some(key) {
            return;
        }
        self.gesture = Some(key);
        self.before.push((present, name()));
        if self.before.len() > CAPACITY {
            self.before.remove(0);
        }
    }

    /// Ends the gesture: the next change starts a new step.
    pub(crate) fn end_gesture(&mut self) {
        self.gesture = None;
    }

    /// The state before the current gesture, which leaves no step behind.
    ///
    /// # Errors
    /// Returns `present` when no gesture is in progress.
    pub(crate) fn abandon_gesture(&mut self, present: State) -> Result<State, State> {
        match self.gesture.take().and_then(|_| self.before.pop()) {
            Some((state, _)) => Ok(state),
            None => Err(present),
        }
    }

    /// The name of the step that `undo` would revert; `None` without such a step.
    pub(crate) fn undoable(&self) -> Option<&str> {
        self.before.last().map(|(_, name)| name.as_str())
    }

    /// The name of the step that `redo` would repeat; `None` without such a step.
    pub(crate) fn redoable(&self) -> Option<&str> {
        self.after.last().map(|(_, name)| name.as_str())
    }

    /// The names of all steps, from the oldest: first the done ones, then the undone ones.
    pub(crate) fn steps(&self) -> impl Iterator<Item = &str> {
        self.before.iter().chain(self.after.iter().rev()).map(|(_, name)| name.as_str())
    }

    /// How many of the steps are done.
    pub(crate) fn done(&self) -> usize {
        self.before.len()
    }

    /// The state before the last step, in exchange for `present`.
    ///
    /// # Errors
    /// Returns `present` when no step is left to undo.
    pub(crate) fn undo(&mut self, present: State) -> Result<State, State> {
        self.gesture = None;
        exchange(&mut self.before, &mut self.after, present)
    }

    /// The state after the last undone step, in exchange for `present`.
    ///
    /// # Errors
    /// Returns `present` when no step is left to redo.
    pub(crate) fn redo(&mut self, present: State) -> Result<State, State> {
        self.gesture = None;
        exchange(&mut self.after, &mut self.before, present)
    }
}

fn exchange<State>(
    from: &mut Vec<(State, String)>,
    to: &mut Vec<(State, String)>,
    present: State,
) -> Result<State, State> {
    match from.pop() {
        Some((state, name)) => {
            to.push((present, name));
            Ok(state)
        }
        None => Err(present),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_is_one_step() {
        let mut history = History::default();
        for state in 0..10 {
            history.record(state, "drag", || "drag".to_owned());
        }
        assert_eq!(history.undo(10), Ok(0));
        assert_eq!(history.undo(0), Err(0), "nothing is left");
        assert_eq!(history.redo(0), Ok(10));
    }

    #[test]
    fn two_drags_are_two_steps() {
        let mut history = History::default();
        history.record(0, "drag", || "drag".to_owned());
        history.end_gesture();
        history.record(1, "drag", || "drag".to_owned());
        assert_eq!(history.undo(2), Ok(1));
        assert_eq!(history.undo(1), Ok(0));
    }

    #[test]
    fn another_key_is_another_step() {
        let mut history = History::default();
        history.record(0, "drag", || "drag".to_owned());
        history.record(1, "colour", || "colour".to_owned());
        assert_eq!(history.undoable(), Some("colour"));
        assert_eq!(history.undo(2), Ok(1));
        assert_eq!((history.redoable(), history.undoable()), (Some("colour"), Some("drag")));
        assert_eq!((history.steps().collect::<Vec<_>>(), history.done()), (vec!["drag", "colour"], 1));
    }

    #[test]
    fn a_change_after_undo_clears_redo() {
        let mut history = History::default();
        history.record(0, "a", || "a".to_owned());
        assert_eq!(history.undo(1), Ok(0));
        history.record(0, "b", || "b".to_owned());
        assert_eq!(history.redo(5), Err(5));
    }

    #[test]
    fn an_abandoned_gesture_leaves_no_trace() {
        let mut history = History::default();
        history.record(0, "drag", || "drag".to_owned());
        history.record(1, "drag", || "drag".to_owned());
        assert_eq!(history.abandon_gesture(2), Ok(0));
        assert_eq!(history.abandon_gesture(0), Err(0), "the gesture has ended");
        assert_eq!((history.undoable(), history.redoable()), (None, None));
    }

    #[test]
    fn the_oldest_states_are_dropped_first() {
        let mut history = History::default();
        for state in 0..CAPACITY + 5 {
            history.record(state, state, || state.to_string());
        }
        assert_eq!((history.before.len(), history.before.first()), (CAPACITY, Some(&(5, "5".to_owned()))));
    }
}
