"""How GraFu is trained: losses, matching, the data it sees, the loop."""
