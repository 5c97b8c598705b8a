//! A few rounds of the soak, and those in which it once found something.
use carom_bench::soak::{Old, Tally, round};

fn passes(seeds: impl IntoIterator<Item = u64>) -> Tally {
    let mut tally = Tally::default();
    seeds.into_iter().for_each(|seed| round(seed, &mut tally));
    assert_eq!((tally.given_up, &tally.wrong[..]), (0, &[][..]));
    tally
}

#[test]
fn the_first_rounds() {
    let tally = passes(1..=60);
    assert!(tally.impacts > 10_000 && tally.slices > 1_000 && tally.restored > 100, "nothing happened");
}

/// A body left its island without a new record, and others went on to meet where it would have been.
#[test]
fn who_changes_course_is_predicted_anew() {
    passes([1893]);
}

/// How far slices look depended on the bodies that there had been, which a restored world does not know.
#[test]
fn a_restored_world_looks_as_far() {
    passes([2200]);
}

/// A ball that had met a wall in vain was given a velocity, and was not looked at again before it was through.
#[test]
fn who_is_pushed_does_not_wait() {
    passes([1612]);
}

/// A wall that was given another velocity was met where it had never been.
#[test]
fn driven_walls_are_met_where_they_are() {
    passes([55_966]);
}

/// Where nothing bounces, speeds halved from impact to impact down to 1e-99 m/s, at one instant.
#[test]
fn halving_speeds_come_to_an_end() {
    passes([2511]);
}

/// An island that merged with another measured its bodies where they had been before their slice.
#[test]
fn islands_merge_where_their_bodies_are() {
    passes([10_624]);
}

/// A slice may leave a body beside its path: whoever comes from outside was not looked for as far.
#[test]
fn who_may_be_met_beside_the_path_is_looked_for() {
    passes([23_803]);
}

/// A body of an island and one from outside parted, very near to each other; the island was stopped, and the other ran into it unseen.
#[test]
fn who_parts_from_an_island_may_still_run_into_it() {
    passes([22_609]);
}

/// The same, seen otherwise.
#[test]
fn who_parts_may_run_into_it_later() {
    passes([28_909]);
}

/// Who rests, and was hit without moving for it, did not look on for its next meeting, and was run through.
#[test]
fn who_rests_looks_on_after_it_was_hit() {
    passes([33_873]);
}

/// Two that moved side by side, one in a slice and one out of it, were looked at 1e-10 s later, again and again.
#[test]
fn who_moves_along_beside_a_slice_is_not_looked_at_for_ever() {
    passes([301_354, 417_286]);
}

/// One that neither nears a slice nor leaves it is looked at again as one that leaves it is.
#[test]
fn who_keeps_its_distance_from_a_slice_is_looked_at_again() {
    passes([596_989, 612_190]);
}

#[test]
fn a_world_whose_bodies_are_replaced() {
    let (mut old, mut tally) = (Old::default(), Tally::default());
    (0..5).for_each(|_| old.live(&mut tally));
    assert!(tally.wrong.is_empty() && old.world.impact_count() > 1_000, "{:?}", tally.wrong);
}

/// One of two that overlapped was let go, because the slice as planned would have parted them later; each slice that was cut short before left
/// them deeper.
#[test]
fn who_hops_inside_an_overlap_stays_in_its_island() {
    passes([210_559]);
}

/// Who was to be looked at again, when it could have come half the way, was thrown on by the others of its island.
#[test]
fn who_waits_is_looked_at_as_fast_as_its_slice_takes_it() {
    passes([300_721]);
}

/// A ball that waited for two others remembered only the last one, and cut its slice for either in turn, without end.
#[test]
fn who_waits_for_two_waits_for_both() {
    passes([312_274]);
}
