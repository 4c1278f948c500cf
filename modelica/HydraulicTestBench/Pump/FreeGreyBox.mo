within HydraulicTestBench.Pump;
model FreeGreyBox "Swash plate control with the free parameter set, thesis Table 4.6"
  extends SwashPlateControl(data=Data.FreeGreyBox());
  annotation(Documentation(info="<html>
<p>The pump with stroke and piston area identified; the FMU of the <i>free</i> set.</p>
<p><b>Source:</b> thesis Table 4.6, in <code>Data.FreeGreyBox</code>.</p>
<p><b>Valid, leaves out:</b> see <code>SwashPlateControl</code>.</p>
</html>"));
end FreeGreyBox;
