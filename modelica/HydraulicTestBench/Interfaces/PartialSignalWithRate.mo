within HydraulicTestBench.Interfaces;
partial model PartialSignalWithRate "Slot for a signal and its time derivative"
  extends Icons.Slot;
  RealInput s "Signal as the base model has it"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  RealInput s_t "Its time derivative"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  RealOutput y "Signal as the rest of the model sees it"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  RealOutput y_t "Time derivative of y"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  annotation(Documentation(info="<html>
<p>For what may act on a quantity whose rate the PD controller needs (Eq. 3.17). The law is two equations, for y and for
y_t, and y_t has to be the derivative of y: a static law y = f(s) gives y_t = f'(s) s_t, a law with y as a state gives
y_t = der(y). In the base model y = s and y_t = s_t. The units are those of the place: m for the linkage, rad for the
sensor and the angle error.</p>
<p><b>Source:</b> this library; it marks the places of thesis Fig. 3.4 where physics may be missing.</p>
<p><b>Used by:</b> <code>linkage</code>, <code>angleSensor</code>, <code>angleError</code> of
<code>Pump.SwashPlateControl</code>.</p>
</html>"));
end PartialSignalWithRate;
