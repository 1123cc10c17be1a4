"""The parts of a comparison, in the order in which they are shown, and what each is."""

PARTS = {
    "options": ("What the runs were asked to do", "Configuration, command line, seeds and versions as the manifests have them."),
    "inputs": ("What the runs read", "Input files by the beginning of their SHA-256."),
    "outcome": ("How the steps ended", "Steps that only one run has, their status and warnings."),
    "diagnosis": ("Diagnosis", "Verdict, effects with probability and size, gain, the model's parameters after it."),
    "parameters": ("Parameters of the updating", "Values before and after, and bounds."),
    "predictions": ("Predictions", "Pairs left out of the updating, critical wind speeds, accelerations."),
    "fit": ("The updating in numbers", ""),
    "identified modes": ("Identified modes", "Modes of both runs paired by their shapes."),
    "pairs": ("Measured and computed modes", "Pairs, frequencies, errors and MAC of steps 4, 6 and 9."),
    "modes": ("Modes of the model", "Modes of both runs paired by their shapes."),
    "selection": ("Selection of parameters", "What the frequencies can tell about each parameter."),
    "model": ("The model", ""),
    "sensors": ("Sensor layouts", ""),
}


def words(row: dict) -> str:
    """'k_base final value': the item with its quantity, underscores as spaces but in names."""
    if row["quantity"] == "value":
        return row["item"].replace("_pct", "").replace("_", " ")
    quantity = row["quantity"] if row["part"] in ("options", "inputs") else row["quantity"].replace("_pct", "").replace("_Hz", "").replace("_", " ")
    return f"{row['item']} {quantity}".strip() if row["part"] not in ("options", "inputs") else quantity
