"""The furniture as it stands: what joints and additions see of it. It builds and adds nothing."""
