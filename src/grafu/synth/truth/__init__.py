"""The truth about made furniture: its functional graph, its articulated object, and checks that both hold."""
