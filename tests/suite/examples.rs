//! Examples that check what they show.

#[path = "../../examples/own_number.rs"]
mod own_number;

#[test]
fn own_numbers_lead_to_the_exact_result() {
    own_number::main().expect("the scene is a valid PLC");
}
