"""The truth about synthetic furniture: its functional graph, its articulated object, and checks that both hold."""
