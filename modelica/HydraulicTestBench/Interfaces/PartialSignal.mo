within HydraulicTestBench.Interfaces;
partial model PartialSignal "Slot for a signal: s in, y out"
  extends Icons.Slot;
  RealInput s(unit="1") "Signal as the base model has it"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  RealOutput y(unit="1") "Signal as the rest of the model sees it"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  annotation(Documentation(info="<html>
<p>For what may act on a spool command or a spool opening: y is a law of s, static or with states of its own. The law is
one equation that gives y; in the base model it is y = s.</p>
<p><b>Source:</b> this library; it marks the places of thesis Fig. 3.4 where physics may be missing.</p>
<p><b>Used by:</b> <code>cardOutput</code>, <code>spoolCommand</code>, <code>spoolOpening</code> of
<code>Pump.SwashPlateControl</code>.</p>
</html>"));
end PartialSignal;
