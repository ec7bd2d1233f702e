"""What a fit returns: the model, how well it matches, whether it may pass for a tire, figures."""
