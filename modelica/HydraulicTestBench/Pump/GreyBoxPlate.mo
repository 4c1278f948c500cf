within HydraulicTestBench.Pump;
model GreyBoxPlate "Swash plate by its card, valve and cylinder"
  extends Interfaces.PartialSwashPlate;
  FreeGreyBox control(final alphaMAX=alphaMAX, stroke_share=0.95) "Swash plate control"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
equation
  connect(alphaCMD, control.alphaCMD);
  connect(alphaCMD_t, control.alphaCMD_t);
  alpha = control.alpha;
  alpha_t = control.alpha_t;
  alphaPercent = control.alphaPercent;
  annotation(Documentation(info="<html>
<p>The pump's non-linear model, with its stop at 95 percent.</p>
<p><b>Source:</b> thesis Section 3.2 and 3.3, Table 4.6.</p>
<p><b>Valid, leaves out:</b> see <code>SwashPlateControl</code>.</p>
</html>"));
end GreyBoxPlate;
